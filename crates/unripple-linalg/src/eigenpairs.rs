//! Eigenvalues and eigenvectors of a matrix without symmetry.

use faer::{Mat, c64};

/// Eigenvalues and right eigenvectors of a general (not necessarily symmetric) n x n matrix.
#[derive(Clone, Debug)]
pub struct General {
    /// The n eigenvalues, in no particular order.
    pub values: Vec<c64>,
    /// The right eigenvectors in the columns of an n x n matrix, in the order of the eigenvalues.
    pub vectors: Mat<c64>,
}
