//! All data from which a report on waveforms or a stroke is made.

use unripple::act::{Judged, Report};
use unripple::core::{Drive, Surface};

/// The report on waveforms or a stroke, together with all data from which it was made.
#[derive(Debug)]
pub struct Made {
    /// The report, as `run` returns it.
    pub report: Report,
    /// The drive as it is emitted: float32 samples in the actuators' unit.
    pub drive: Drive,
    /// Evaluation of the drive's field: metrics, traces at the targets, and maps.
    pub judged: Judged,
    /// The surface that the drive was evaluated on.
    pub surface: Surface,
}
