//! Why eigenpairs were not found.

/// Why the eigenpairs of a pencil were not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum SpectrumError {
    /// The matrices are not a pencil of the kind asked for.
    #[error("{what}: expected {expected}, found {found}")]
    Matrices {
        /// What is wrong.
        what: &'static str,
        /// What is legal.
        expected: String,
        /// What was found.
        found: String,
    },
    /// Neither at the shift nor beside it does K - σM have factors that can be trusted.
    #[error("factors of K - σM at σ = {shift:e}: expected pivots clear of zero, found none nearby")]
    Factors {
        /// The shift σ.
        shift: f64,
    },
    /// Fewer or more eigenpairs were found than inertia proves to exist.
    #[error("eigenpairs below {top:e}: expected {expected} by inertia, found {found}")]
    Missed {
        /// The bound.
        top: f64,
        /// The number that exist.
        expected: usize,
        /// The number found.
        found: usize,
    },
}
