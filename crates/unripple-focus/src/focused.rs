//! A computed drive, and when it focuses.

use crate::{Method, Timing};
use unripple_core::{Drive, Point};

/// A computed drive, and when it focuses.
#[derive(Clone, Debug, PartialEq)]
pub struct Focused {
    /// The drive to be sent to the actuators.
    pub drive: Drive,
    /// Focal instant and period of each target.
    pub timing: Vec<Timing>,
    /// Common period of all repeated targets, in samples; `None` if none is repeated. The last full period of the drive
    /// is its last `period` samples.
    pub period: Option<usize>,
    /// The points on which each target was focused: those requested or, with sampled responses, the nearest
    /// stored ones.
    pub points: Vec<Vec<Point>>,
    /// The method by which the drive was computed.
    pub method: Method,
    /// How the amplitude limits changed the waveforms, apart from scaling the whole drive by one factor.
    pub shaping: Shaping,
}

/// How the amplitude limits changed the waveforms of a drive, apart from scaling the whole drive by one
/// factor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shaping {
    /// The limits did not change the waveforms, apart from one common factor.
    #[default]
    Unshaped,
    /// The limits changed the waveforms: the drive is one-bit, or some of its samples are clipped at a
    /// limit.
    Shaped,
    /// [`Method::Limited`] found no drive that brings several targets together to higher levels than the
    /// drive computed without limits does once it is scaled to the limits; that scaled drive is the result.
    GaveUp {
        /// Number of levels tried, each half as far above the level of the scaled drive as the one before.
        attempts: usize,
    },
}

impl Focused {
    /// When each target is in focus, in seconds from the first sample of the drive.
    pub fn instants(&self) -> impl Iterator<Item = f64> + '_ {
        self.timing.iter().map(|timing| timing.instant as f64 / self.drive.rate())
    }

    /// When the first target is in focus, in seconds; 0 without targets.
    pub fn instant(&self) -> f64 {
        self.instants().next().unwrap_or(0.0)
    }
}
