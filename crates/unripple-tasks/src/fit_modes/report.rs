//! Report of the task `fit_modes`.

use super::{Losses, Mode, Other, Untold, Value};
use serde::Serialize;
use unripple::act::Note;

/// A surface fitted to natural frequencies, what they do not tell, and others that explain them as well.
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
    /// How the sides of the surface are held.
    pub sides: String,
    /// Relative standard deviation of the frequencies that was stated.
    pub error: f64,
    /// The fitted quantities.
    pub quantities: Vec<Value>,
    /// The measured frequencies and their modes, ascending.
    pub modes: Vec<Mode>,
    /// Frequencies of modes between these that were not heard, in Hz.
    pub missed_hz: Vec<f64>,
    /// Measured frequencies that are no mode, in Hz.
    pub spurious_hz: Vec<f64>,
    /// Sum of the squared residuals over the error, and of 3 for each missed mode and 16 for each spurious frequency.
    pub cost: f64,
    /// Root mean square of the residuals over the error, per degree of freedom; 1 if there are no more modes than quantities.
    pub excess: f64,
    /// Damping, if there were decay times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub losses: Option<Losses>,
    /// What frequencies do not tell.
    pub untold: Vec<Untold>,
    /// Other surfaces that explain the frequencies as well, or better because their sides are held otherwise.
    pub others: Vec<Other>,
    /// Number of starts of the fit.
    pub starts: usize,
    /// The text of the fitted surface file.
    pub surface_toml: String,
    /// Notes on the fit.
    pub notes: Vec<Note>,
    /// Files in the output folder, beside the report.
    pub files: Vec<String>,
}
