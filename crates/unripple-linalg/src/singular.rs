//! Singular value decomposition.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::svd::{ComputeSvdVectors, svd, svd_scratch};
use faer::{Mat, MatRef, Par};

/// The singular values and left singular vectors of an m x n matrix U diag(values) Vᵀ; V is not computed.
#[derive(Clone, Debug)]
pub struct Singular {
    /// The left singular vectors, the columns of U, m x min(m, n).
    pub left: Mat<f64>,
    /// The min(m, n) singular values, descending.
    pub values: Vec<f64>,
}

/// The singular values and left singular vectors of an m x n matrix; `None` if the iteration does not converge, as when entries are not
/// finite.
pub fn singular(matrix: MatRef<'_, f64>) -> Option<Singular> {
    let (m, n) = matrix.shape();
    let least = m.min(n);
    let (mut values, mut left) = (Diag::<f64>::zeros(least), Mat::zeros(m, least));
    let (thin, none) = (ComputeSvdVectors::Thin, ComputeSvdVectors::No);
    let needed = svd_scratch::<f64>(m, n, thin, none, Par::Seq, Default::default());
    let mut buffer = MemBuffer::try_new(needed).ok()?;
    let (to, stack) = (Some(left.as_mut()), MemStack::new(&mut buffer));
    svd(matrix, values.as_mut(), to, None, Par::Seq, stack, Default::default()).ok()?;
    Some(Singular { left, values: values.column_vector().iter().copied().collect() })
}
