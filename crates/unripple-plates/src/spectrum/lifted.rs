//! Responses of a pencil in which known eigenvalues are lifted out of the way.

use super::SpectrumError;
use super::factor::Factor;
use super::panel::{LANES, NONE};
use super::pencil::Pencil;
use super::plan::{STEP, factor_near};
use super::solve::solve;
use super::times::symmetric_times;
use crate::modes::eigen::product;
use rayon::prelude::*;
use unripple_linalg::sparse::SparseColMatRef;
use unripple_linalg::{Mat, MatRef, Par, col_chunks, exact_symmetric};

/// The work fᵀ(K - σM + 2σMXXᵀM)⁻¹f of the residual f = Kx - λMx of each of the approximate eigenpairs (λ, X), for a shift σ of `top` or
/// slightly more. `None` if that matrix is not positive definite: the pencil then has more eigenvalues below σ than these.
///
/// X is unknowns x pairs, with XᵀMX = 1 and XᵀKX diagonal. With A = K - σM, each Ax = f + (λ-σ)Mx, so that the factors of A are applied to
/// f alone; the rank of the rest is the number of pairs (Woodbury's identity; Golub and Van Loan, *Matrix Computations*, 2013, section
/// 2.1.4).
///
/// # Errors
/// As [`below`](super::below).
pub(crate) fn lifted_works(
    stiffness: SparseColMatRef<usize, f64>,
    mass: SparseColMatRef<usize, f64>,
    top: f64,
    (values, vectors): (&[f64], MatRef<f64>),
) -> Result<Option<Vec<f64>>, SpectrumError> {
    let pencil = Pencil::new(stiffness, mass)?;
    let factor = factor_near(&pencil, top, top * STEP)?;
    let count = values.len();
    let weighed = symmetric_times(mass, vectors);
    let mut forces = symmetric_times(stiffness, vectors);
    for (m, value) in values.iter().enumerate() {
        forces.col_mut(m).iter_mut().zip(weighed.col(m).iter()).for_each(|(f, w)| *f -= value * w);
    }
    let responses = responses(&pencil, &factor, forces.as_ref());
    // MX against the responses to f, and against those to MX: (1 - that) / (λ-σ), and the inverse of 2σ on the diagonal.
    let between = product(weighed.transpose(), responses.as_ref(), Par::Seq);
    let rest =
        |i: usize, j: usize| (f64::from(u8::from(i == j)) - between[(i, j)]) / (values[j] - factor.shift);
    let inner = Mat::from_fn(count, count, |i, j| {
        0.5 * (rest(i, j) + rest(j, i)) + if i == j { 0.5 / factor.shift } else { 0.0 }
    });
    let Some((scales, turn)) = exact_symmetric(inner.as_ref()) else { return Ok(None) };
    // The lifted matrix is positive definite if and only if A and the inner matrix have equally many negative eigenvalues (Haynsworth's
    // additivity of inertia).
    if factor.below != scales.iter().filter(|scale| **scale < 0.0).count() {
        return Ok(None);
    }
    let turned = product(turn.transpose(), between.as_ref(), Par::Seq);
    let work = |m: usize| {
        let direct: f64 = forces.col(m).iter().zip(responses.col(m).iter()).map(|(f, u)| f * u).sum();
        let lifted: f64 = turned.col(m).iter().zip(&scales).map(|(w, scale)| w * w / scale).sum();
        direct - lifted
    };
    Ok(Some((0..count).map(work).collect()))
}

/// The columns of A⁻¹F, for the factors of A.
fn responses(pencil: &Pencil, factor: &Factor, forces: MatRef<f64>) -> Mat<f64> {
    let mut responses = Mat::zeros(forces.nrows(), forces.ncols());
    col_chunks(responses.as_mut(), LANES).into_par_iter().enumerate().for_each(|(chunk, mut columns)| {
        let mut panel = vec![NONE; pencil.len()];
        for lane in 0..columns.ncols() {
            let force = forces.col(chunk * LANES + lane);
            for ((row, old), scale) in panel.iter_mut().zip(&pencil.order).zip(&pencil.scale) {
                row[lane] = scale * force[*old];
            }
        }
        solve(pencil.arch, factor, &mut panel, &mut Vec::new());
        for lane in 0..columns.ncols() {
            let mut column = columns.as_mut().col_mut(lane);
            for ((row, old), scale) in panel.iter().zip(&pencil.order).zip(&pencil.scale) {
                column[*old] = scale * row[lane];
            }
        }
    });
    responses
}
