//! All data from which a report on a focus is made.

use super::Report;
use unripple::act::Judged;
use unripple::core::{Drive, Responses, Surface};
use unripple::focus::Focused;

/// The report on a focus, together with all data from which it was made.
#[derive(Debug)]
pub struct Made {
    /// The report, as `run` returns it.
    pub report: Report,
    /// The drive as it is emitted: float32 samples in the actuators' unit.
    pub drive: Drive,
    /// Evaluation of the drive's field: metrics, traces at the targets, and maps.
    pub judged: Judged,
    /// The drive before it was scaled to the requested level, with the focal instant of each target.
    pub focused: Focused,
    /// The surface that the drive was evaluated on.
    pub surface: Surface,
    /// The responses that the drive was computed from.
    pub responses: Responses,
    /// Whether absolute displacements and velocities are known; `false` for a library of responses of
    /// unknown scale.
    pub scaled: bool,
}
