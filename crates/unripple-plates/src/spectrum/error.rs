//! The errors of the eigenvalue solver.

/// Why the eigenpairs of a matrix pencil were not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum SpectrumError {
    /// The matrices are not a symmetric pencil of the required kind.
    #[error("{what}: expected {expected}, found {found}")]
    Matrices {
        /// Name of the wrong quantity.
        what: &'static str,
        /// Allowed values of the quantity.
        expected: String,
        /// What was found.
        found: String,
    },
    /// The matrix K - σM could not be factored accurately, neither at the shift nor at shifts nearby.
    #[error("factors of K - σM at σ = {shift:e}: expected pivots clear of zero, found none nearby")]
    Factors {
        /// The shift σ.
        shift: f64,
    },
    /// The number of eigenpairs found is not the number given by inertia.
    #[error("eigenpairs below {top:e}: expected {expected} by inertia, found {found}")]
    Missed {
        /// The bound below which all eigenpairs were requested.
        top: f64,
        /// The number of eigenpairs that exist.
        expected: usize,
        /// The number of eigenpairs found.
        found: usize,
    },
}

/// The error for a mass matrix that is not positive definite; `found` is the value of xᵀMx for some x.
pub(super) fn indefinite(found: f64) -> SpectrumError {
    SpectrumError::Matrices {
        what: "square of a norm in M",
        expected: "a positive number".to_owned(),
        found: format!("{found:e}"),
    }
}
