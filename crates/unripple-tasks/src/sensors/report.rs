//! Report of the task `sensors`.

use super::SensingAsk;
use super::planned::{Certificate, Number, Pair, Unknown};
use serde::Serialize;
use unripple::act::Note;

/// Places of sensors or taps, what a fit would know with them, and how good they are beside others.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// Name of the surface.
    pub surface: String,
    /// Number of places that were planned.
    pub count: usize,
    /// What is measured at each.
    pub sensing: SensingAsk,
    /// Places that are measured in any case, in m.
    pub kept_m: Vec<[f64; 2]>,
    /// Number of places that were chosen from.
    pub places: usize,
    /// Spacing of the grid of places, in m; absent where places were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch_m: Option<f64>,
    /// Lowest and highest frequency that is fitted, in Hz.
    pub band_hz: [f64; 2],
    /// Number of frequencies that are fitted.
    pub lines: usize,
    /// Signal-to-noise ratio, in dB.
    pub snr_db: f64,
    /// The planned places, in m, the one that tells most first.
    pub at_m: Vec<[f64; 2]>,
    /// What a fit would know of each unknown.
    pub unknowns: Vec<Unknown>,
    /// Names of unknowns of the fit of which no place tells anything.
    pub untold: Vec<String>,
    /// The two unknowns that a fit tells apart worst.
    pub worst_pair: Pair,
    /// Efficiencies of what the search reached from each beginning, the greedy one first.
    pub reached: Vec<f64>,
    /// How good the places are.
    pub certificate: Certificate,
    /// Choices of every number of places, each made from the one before.
    pub each_number: Vec<Number>,
    /// Notes on the plan.
    pub notes: Vec<Note>,
    /// Files in the output folder, beside the report.
    pub files: Vec<String>,
}
