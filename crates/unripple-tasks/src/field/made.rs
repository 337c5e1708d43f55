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
    /// Figures, traces and maps.
    pub judged: Judged,
    /// Places and instants at which the field was measured.
    pub aims: Vec<Aim>,
    /// The surface that was driven.
    pub surface: Surface,
    /// The responses of the surface. A [`Field`](unripple::field::Field) of these and the drive gives everything else.
    pub responses: Responses,
    /// Whether absolute lengths and velocities are known: not for a library without a scale.
    pub scaled: bool,
    /// What the instants are, for figures.
    pub when: When,
}
