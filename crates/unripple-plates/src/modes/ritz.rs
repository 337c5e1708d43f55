//! The lowest modes of an energy matrix between orthonormal functions, and what further functions would change.

use super::eigen::{orthonormalised, product};
use unripple_linalg::{Accum, Cholesky, Mat, MatRef, Par, exact_symmetric, multiply};

/// Modes are computed up to this share above the top ω², so that the modes that are left out are well
/// separated from those that are kept. Halved, they are closer, and each iteration removes less of them.
pub(crate) const ABOVE: f64 = 0.3;

/// Number of times that the inverse is applied to the vectors (subspace iteration). Each time, rounding
/// errors along vectors of high energy shrink by the ratio of that energy to the top energy; one more
/// changes only the last digits.
const SWEEPS: usize = 2;

/// Eigenvalues up to the share [`ABOVE`] above `top`, and their vectors.
///
/// The largest eigenvalues of the energy matrix H are 10¹⁰ times the lowest, and the rounding errors of its decomposition
/// would be relative to the largest. Therefore (H + top)⁻¹ is decomposed, whose largest eigenvalues belong to the modes in
/// question. Applying it to their vectors again removes the parts of highest energy that rounding left; the error of the
/// rest is made second order by a final Rayleigh-Ritz step with H between these vectors (subspace iteration; Parlett, *The
/// Symmetric Eigenvalue Problem*, 1998, chapter 14).
pub(super) fn lowest(energy: &Mat<f64>, top: f64, par: Par) -> Option<(Vec<f64>, Mat<f64>)> {
    let n = energy.nrows();
    let mut shifted = energy.clone();
    (0..n).for_each(|i| shifted[(i, i)] += top);
    let inverse = Cholesky::new(shifted.as_ref())?.inverse();
    let (values, mut vectors) = at_least(&inverse, 1.0 / (top * (2.0 + ABOVE)))?;
    for _ in 0..SWEEPS {
        let mut swept = product(inverse.as_ref(), vectors.as_ref(), par);
        for (column, value) in swept.col_iter_mut().zip(&values) {
            column.iter_mut().for_each(|v| *v /= value);
        }
        vectors = orthonormalised(swept, par);
    }
    let forces = product(energy.as_ref(), vectors.as_ref(), par);
    let between = product(vectors.transpose(), forces.as_ref(), par);
    let (values, rotation) = exact_symmetric(between.as_ref())?;
    Some((values, product(vectors.as_ref(), rotation.as_ref(), par)))
}

/// The eigenvalues of at least `least` of a symmetric matrix, descending, and their vectors.
fn at_least(matrix: &Mat<f64>, least: f64) -> Option<(Vec<f64>, Mat<f64>)> {
    let (values, vectors) = exact_symmetric((-matrix).as_ref())?;
    let kept = values.partition_point(|value| -value >= least);
    Some((values[..kept].iter().map(|value| -value).collect(), vectors.subcols(0, kept).to_owned()))
}

/// Estimated largest relative error of a frequency: the change by further functions, of which a quarter more have been counted in,
/// doubled to account for all others.
///
/// To second order ω² falls by rᵀ(H - ω²)⁻¹r, with r the force of a mode on the further functions and H the energy
/// of all functions, the computed modes projected out (Löwdin, *J. Math. Phys.* 3, 969, 1962). They are projected out by
/// shifting their energy above the top. `lifted` is H - `top` of all functions, those of the modes first (its lower triangle is read), and
/// `between` the energy between the further ones (rows) and those of the modes (columns). Infinite if the further functions have more modes
/// below the top.
pub(super) fn missing(
    mut lifted: Mat<f64>,
    between: MatRef<f64>,
    (squares, coefficients): (&[f64], &Mat<f64>),
    top: f64,
    par: Par,
) -> f64 {
    let (all, n) = (lifted.nrows(), between.ncols());
    if n == all {
        return 0.0;
    }
    let inner = lifted.as_mut().submatrix_mut(0, 0, n, n);
    multiply(inner, Accum::Add, coefficients.as_ref(), coefficients.transpose(), 2.0 * top, par);
    let Some(factor) = Cholesky::new(lifted.as_ref()) else {
        return f64::INFINITY;
    };
    let mut force = Mat::zeros(all, squares.len());
    let rest = force.as_mut().subrows_mut(n, all - n);
    multiply(rest, Accum::Replace, between, coefficients.as_ref(), 1.0, par);
    let mut response = force.clone();
    factor.solve(response.as_mut());
    let inside = squares.partition_point(|square| *square <= top);
    (0..inside)
        .map(|m| {
            let change: f64 = force.col(m).iter().zip(response.col(m).iter()).map(|(f, u)| f * u).sum();
            change / squares[m]
        })
        .fold(0.0, f64::max)
}
