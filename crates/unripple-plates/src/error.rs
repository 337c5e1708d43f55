//! Why the modes of a sheet could not be computed.

use unripple_core::{OutOfRange, OutlineFault};

/// Why the physics of a surface could not be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PhysicsError {
    /// Something the models here do not cover.
    #[error("{what}: expected {expected}, found {found}")]
    Unsupported {
        /// What was asked about.
        what: &'static str,
        /// What is supported.
        expected: &'static str,
        /// What was found.
        found: String,
    },
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// The problem is too large for the memory it is allowed.
    #[error(
        "modes up to {max_hz} Hz: expected at most {limit_gib:.1} GiB, found {needed_gib:.1} GiB for {unknowns} unknowns; about {nearest_hz:.0} Hz fits"
    )]
    TooLarge {
        /// The frequency asked for, in Hz.
        max_hz: f64,
        /// The unknowns it takes.
        unknowns: usize,
        /// The memory that they take, in GiB.
        needed_gib: f64,
        /// The memory allowed, in GiB.
        limit_gib: f64,
        /// A top frequency that fits, in Hz.
        nearest_hz: f64,
    },
    /// The accuracy asked for was not reached.
    #[error("modes up to {max_hz} Hz: expected an error of at most {expected:e}, found {found:e}")]
    NotConverged {
        /// The frequency asked for, in Hz.
        max_hz: f64,
        /// The relative accuracy asked for.
        expected: f64,
        /// The relative error estimated.
        found: f64,
    },
    /// The outline encloses no sheet that can be covered with triangles.
    #[error("outline: expected {expected}, found {found}")]
    Outline {
        /// What an outline has to be.
        expected: &'static str,
        /// What was found, and where.
        found: String,
    },
    /// The eigenproblem of a mesh was not solved.
    #[error("modes up to {max_hz} Hz: expected every one of them, found {found}")]
    Solver {
        /// The frequency asked for, in Hz.
        max_hz: f64,
        /// What went wrong.
        found: String,
    },
}

impl From<Vec<OutlineFault>> for PhysicsError {
    /// The first of the faults, in words for people.
    fn from(faults: Vec<OutlineFault>) -> Self {
        let (expected, found) =
            faults.first().map_or(("a sheet", String::new()), |fault| (fault.expected(), fault.found()));
        Self::Outline { expected, found }
    }
}
