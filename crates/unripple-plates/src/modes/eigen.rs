//! Products of matrices, matrices of nearly orthonormal columns, and the sign of a column.

use unripple_linalg::{Accum, ColRef, Mat, MatRef, Par, multiply};

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

/// The factor +1 or -1 that makes positive the first coefficient that is at least half the largest.
pub(crate) fn sign(coefficients: ColRef<f64>) -> f64 {
    let largest = coefficients.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
    coefficients.iter().find(|c| c.abs() >= 0.5 * largest).map_or(1.0, |c| c.signum())
}
