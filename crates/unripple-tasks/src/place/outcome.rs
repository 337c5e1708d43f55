//! What a search comes to, before anything is written.

use super::Report;
use super::figure::Drawn;

/// What a search comes to.
pub(super) struct Outcome {
    /// The report, before files are written.
    pub report: Report,
    /// What is drawn beside the report.
    pub drawn: Drawn,
    /// Name and text of the file that says which actuators there are to be.
    pub file: (&'static str, String),
}
