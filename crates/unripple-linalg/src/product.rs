//! Products of matrices.

use faer::linalg::matmul::matmul;
use faer::traits::ComplexField;
use faer::{Accum, Mat, MatRef, Par};

/// The product of two matrices, m x k and k x n, as m x n. Shared among threads but for a single column, whose sums faer would cut in as
/// many parts as there are threads.
///
/// # Panics
/// If the number of columns of `left` is not that of rows of `right`.
pub fn product<T: ComplexField>(left: MatRef<'_, T>, right: MatRef<'_, T>) -> Mat<T> {
    let mut out = Mat::zeros(left.nrows(), right.ncols());
    let par = if left.nrows().min(right.ncols()) > 1 { Par::rayon(0) } else { Par::Seq };
    matmul(out.as_mut(), Accum::Replace, left, right, T::one_impl(), par);
    out
}
