//! Dense generalised eigenvalue problem, for small meshes.

use super::block::EigenBlock;
use super::error::{SpectrumError, indefinite};
use super::panel::LANES;
use super::pencil::Pencil;
use super::plan::{STEP, factor_near};
use crate::modes::eigen::product;
use unripple_linalg::{
    Cholesky, Mat, Par, Scale, exact_symmetric, norm, solve_lower_alone, solve_upper_alone,
};

/// The shift τ, relative to the bound: K may be singular, K + τM is not. Rounding errors are relative to
/// λ + τ: with twice this value, they double for the lowest λ; much smaller, K + τM is nearly singular.
const SHIFT: f64 = 1e-3;

/// All eigenpairs below a bound, or below one slightly above it if factors are more accurate there.
///
/// With M = LLᵀ and K + τM = RRᵀ, (R⁻¹L)ᵀ(R⁻¹L) has the eigenvalues 1/(λ+τ), so that rounding errors are relative to the
/// lowest λ, not to the highest.
///
/// # Errors
/// [`SpectrumError::Matrices`] if M is not positive definite or K not semidefinite; [`SpectrumError::Missed`] if the
/// number of eigenpairs is not that proved by inertia.
pub(super) fn all(pencil: &Pencil, top: f64) -> Result<EigenBlock, SpectrumError> {
    let n = pencil.len();
    let bound = factor_near(pencil, top, top * STEP)?;
    let shift = SHIFT * top;
    let mass = full(pencil, |_, m| m);
    let shifted = full(pencil, |k, m| k + shift * m);
    let mass = Cholesky::new(mass.as_ref()).ok_or_else(|| indefinite(-1.0))?;
    let stiff = Cholesky::new(shifted.as_ref()).ok_or_else(|| indefinite(-1.0))?;
    let mut ratio = mass.lower().to_owned();
    solve_lower_alone(stiff.lower(), ratio.as_mut());
    let inverse = product(ratio.transpose(), ratio.as_ref(), Par::Seq);
    let missed = |found| SpectrumError::Missed { top: bound.shift, expected: bound.below, found };
    let (inverses, vectors) = exact_symmetric(inverse.as_ref()).ok_or_else(|| missed(0))?;
    let value = |i: usize| 1.0 / inverses[n - 1 - i] - shift;
    let found = (0..n).take_while(|i| value(*i) < bound.shift).count();
    if found != bound.below {
        return Err(missed(found));
    }
    let mut chosen = Mat::from_fn(n, found, |i, j| vectors[(i, n - 1 - j)]);
    let rest = product(inverse.as_ref(), chosen.as_ref(), Par::Seq);
    let residuals = (0..found).map(|j| {
        let inverse = inverses[n - 1 - j];
        norm((rest.col(j) - chosen.col(j) * Scale(inverse)).as_mat()) / inverse
    });
    let residuals = residuals.collect();
    solve_upper_alone(mass.lower().transpose(), chosen.as_mut());
    let entry = |i: usize, j: usize| if j < found { chosen[(i, j)] } else { 0.0 };
    let panel = |first: usize| (0..n).map(|i| std::array::from_fn(|lane| entry(i, first + lane))).collect();
    let panels = (0..found).step_by(LANES).map(panel).collect();
    Ok(EigenBlock::new((0..found).map(value).collect(), residuals, panels, 0))
}

/// A linear combination of K and M, as a full matrix with both triangles.
fn full(pencil: &Pencil, sum: impl Fn(f64, f64) -> f64) -> Mat<f64> {
    let lower = &pencil.lower;
    let mut out = Mat::zeros(pencil.len(), pencil.len());
    for j in 0..pencil.len() {
        for at in lower.pattern.col_range(j) {
            let i = lower.pattern.row_idx()[at];
            out[(i, j)] = sum(lower.stiffness[at], lower.mass[at]);
            out[(j, i)] = out[(i, j)];
        }
    }
    out
}
