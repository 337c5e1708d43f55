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
    /// Whether limits changed the shape of the waveforms (one-bit, or samples held at a limit), beyond scaling the
    /// whole drive.
    pub shaped: bool,
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
