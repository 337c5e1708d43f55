//! The errors of computing modes and responses.

use unripple_core::{Memory, OutOfRange, OutlineFault};

/// Why modes, responses or design figures of a surface could not be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PhysicsError {
    /// The models do not cover what was requested.
    #[error("{what}: expected {expected}, found {found}")]
    Unsupported {
        /// Name of the item that is not supported.
        what: &'static str,
        /// What is supported.
        expected: &'static str,
        /// What was found instead.
        found: String,
    },
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// The problem needs more memory than is allowed.
    #[error(
        "modes up to {max_hz} Hz: expected at most {limit_gib:.2} GiB, found {needed_gib:.2} GiB for {unknowns} unknowns; about {nearest_hz:.0} Hz fits, and a coarser accuracy may need less"
    )]
    TooLarge {
        /// The requested top frequency, in Hz.
        max_hz: f64,
        /// Number of unknowns of the problem.
        unknowns: usize,
        /// The memory that the problem needs, in GiB.
        needed_gib: f64,
        /// The memory allowed, in GiB.
        limit_gib: f64,
        /// Approximate highest top frequency for which the problem fits into the allowed memory, in Hz.
        nearest_hz: f64,
    },
    /// The requested accuracy was not reached.
    #[error("modes up to {max_hz} Hz: expected an error of at most {expected:e}, found {found:e}")]
    NotConverged {
        /// The requested top frequency, in Hz.
        max_hz: f64,
        /// The requested relative accuracy.
        expected: f64,
        /// The estimated relative error of the solution.
        found: f64,
    },
    /// The outline encloses no valid sheet, or cannot be meshed.
    #[error("outline: expected {expected}, found {found}")]
    Outline {
        /// What a valid outline would have instead, in words.
        expected: &'static str,
        /// The fault that was found, and where.
        found: String,
    },
    /// The eigenvalue problem of a mesh could not be solved.
    #[error("modes up to {max_hz} Hz: expected every one of them, found {found}")]
    Solver {
        /// The requested top frequency, in Hz.
        max_hz: f64,
        /// The reason of the failure, in words.
        found: String,
    },
}

impl PhysicsError {
    /// The error for modes up to `max_hz` (Hz) with so many unknowns that `needed` bytes would exceed [the memory allowed](Memory::here);
    /// modes up to `nearest_hz` (Hz) would fit.
    pub fn too_large(max_hz: f64, unknowns: usize, needed: f64, nearest_hz: f64) -> Self {
        let limit_gib = Memory::here().bytes() / Memory::GIB;
        Self::TooLarge { max_hz, unknowns, needed_gib: needed / Memory::GIB, limit_gib, nearest_hz }
    }
}

impl From<Vec<OutlineFault>> for PhysicsError {
    /// The error for the first of several faults of an outline.
    fn from(faults: Vec<OutlineFault>) -> Self {
        let (expected, found) =
            faults.first().map_or(("a sheet", String::new()), |fault| (fault.expected(), fault.found()));
        Self::Outline { expected, found }
    }
}
