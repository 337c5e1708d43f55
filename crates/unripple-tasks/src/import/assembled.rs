//! Responses of a surface's points to its actuators, ready for a library.

use super::modal::Synthesis;
use std::collections::BTreeSet;
use unripple::core::{Conditions, Point};

/// Responses of each point, those of all actuators one after the other.
pub(super) enum Rows {
    /// Samples that were measured.
    Stored(Vec<Vec<f32>>),
    /// Modes, of which samples are computed when they are stored.
    Modal(Synthesis),
}

impl Rows {
    /// Responses of a point, actuators x samples, in m/s per unit of drive and second.
    pub fn row(&self, point: usize) -> Vec<f32> {
        match self {
            Self::Stored(rows) => rows[point].clone(),
            Self::Modal(synthesis) => synthesis.row(point),
        }
    }
}

/// Responses that are ready for a library, and what the report says of them.
pub(super) struct Assembled {
    /// Places of the points, in m.
    pub points: Vec<Point>,
    /// Responses of each point.
    pub rows: Rows,
    /// Number of samples of each response.
    pub samples: usize,
    /// Rate, band and shortest wavelength of the responses.
    pub conditions: Conditions,
    /// Kinds of what was read, each once.
    pub kinds: BTreeSet<&'static str>,
    /// Quantities of what was read, each once.
    pub quantities: BTreeSet<&'static str>,
    /// References of what was read, each once.
    pub per: BTreeSet<&'static str>,
    /// The lowest frequency of integrated accelerations, in Hz.
    pub lowest: Option<f64>,
    /// Number of modes; `None` of responses.
    pub modes: Option<usize>,
    /// What was left out and why, for the report.
    pub left_out: Vec<String>,
}
