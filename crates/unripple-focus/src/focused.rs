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
    /// The points each target was focused on: those asked for, or the nearest ones whose responses are stored.
    pub points: Vec<Vec<Point>>,
    /// The method by which the drive was computed.
    pub method: Method,
    /// What the limits did to the waveforms, beyond scaling the whole drive.
    pub shaping: Shaping,
}

/// What the limits of a drive did to its waveforms, beyond scaling the whole drive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shaping {
    /// Limits changed nothing: the waveforms are those that the method gives without them.
    #[default]
    Unshaped,
    /// Limits changed the waveforms: one-bit, or samples held at a limit.
    Shaped,
    /// [`Method::Limited`] found no drive within the limits that gives several targets their levels together, above those that
    /// unshaped waveforms reach: the waveforms are those that it gives without limits, scaled to them.
    GaveUp {
        /// How many levels were tried, each with half of the rise of the one before.
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
