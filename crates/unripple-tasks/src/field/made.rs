//! All data from which a report on a field is made.

use super::Report;
use crate::figures::When;
use unripple::act::Judged;
use unripple::core::{Drive, Responses, Surface};
use unripple::field::Aim;

/// The report on the field of a drive, together with all data from which it was made.
#[derive(Debug)]
pub struct Made {
    /// The report, as `run` returns it.
    pub report: Report,
    /// The drive that was played.
    pub drive: Drive,
    /// Evaluation of the drive's field: metrics, traces at the points, and maps.
    pub judged: Judged,
    /// Places and instants at which the field was evaluated.
    pub aims: Vec<Aim>,
    /// The surface that was driven.
    pub surface: Surface,
    /// The responses of the surface, from which a [`Field`](unripple::field::Field) of the drive gives all
    /// other results.
    pub responses: Responses,
    /// Whether absolute displacements and velocities are known; `false` for a library of responses of
    /// unknown scale.
    pub scaled: bool,
    /// What happens at the instants of `aims`, for the labels of figures.
    pub when: When,
}
