//! Processes that compute the designs of a search.

use crate::sweep::Piece;
use std::path::Path;
use std::process::Command;

/// How a search starts processes.
pub struct Crew<'c> {
    /// Number of processes at a time, at least 1.
    pub jobs: usize,
    /// The command of a process that computes a piece of a sweep, from the plan and the folder of that sweep; see
    /// [`Workers`](crate::sweep::Workers).
    pub command: &'c dyn Fn(&Path, &Path, Piece) -> Command,
}
