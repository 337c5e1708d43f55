//! Symmetric eigenvalue problems, and matrices of nearly orthonormal columns.

use unripple_linalg::{Accum, Mat, MatRef, Par, multiply};

/// The algorithm by which a symmetric matrix is decomposed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Method {
    /// Divide and conquer: fast, but eigenvectors may have errors of 1e-5 where eigenvalues differ by
    /// orders of magnitude.
    Fast,
    /// QR iteration: errors within machine precision of the largest eigenvalue.
    Exact,
}

/// Eigenvalues, ascending, and orthonormal eigenvectors of a symmetric matrix given by its lower triangle; `None` if
/// the iteration does not converge.
pub(crate) fn symmetric(matrix: MatRef<f64>, method: Method) -> Option<(Vec<f64>, Mat<f64>)> {
    match method {
        Method::Fast => unripple_linalg::symmetric(matrix),
        Method::Exact => unripple_linalg::exact_symmetric(matrix),
    }
}

/// The product of two matrices.
pub(crate) fn product(left: MatRef<f64>, right: MatRef<f64>, par: Par) -> Mat<f64> {
    let mut out = Mat::zeros(left.nrows(), right.ncols());
    multiply(out.as_mut(), Accum::Replace, left, right, 1.0, par);
    out
}

/// Makes nearly orthonormal columns orthonormal without changing their span: X ← X (3 - XᵀX)/2, twice
/// (Björck and Bowie, *SIAM J. Numer. Anal.* 8, 358, 1971).
pub(crate) fn orthonormalised(mut columns: Mat<f64>, par: Par) -> Mat<f64> {
    for _ in 0..2 {
        let gram = product(columns.transpose(), columns.as_ref(), par);
        let step = Mat::from_fn(gram.nrows(), gram.ncols(), |i, j| {
            if i == j { 1.5 - 0.5 * gram[(i, j)] } else { -0.5 * gram[(i, j)] }
        });
        columns = product(columns.as_ref(), step.as_ref(), par);
    }
    columns
}
