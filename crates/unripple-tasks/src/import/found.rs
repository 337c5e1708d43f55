//! All that was read of files, before it is joined to the surface.

use super::measured::Measured;
use super::modal::Modes;

/// All that was read of all files.
#[derive(Default)]
pub(super) struct Found {
    /// Responses in the order of the files.
    pub responses: Vec<Measured>,
    /// Modes, by file.
    pub modes: Vec<Modes>,
    /// What was left out and why, for the report.
    pub left_out: Vec<String>,
}
