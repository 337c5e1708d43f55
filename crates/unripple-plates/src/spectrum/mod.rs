//! All eigenpairs below a bound of a sparse symmetric pencil K x = λ M x, without missing any.
//!
//! The spectrum is divided by shifts σ; at each, block Lanczos on (K - σM)⁻¹M finds the nearest eigenpairs on both sides.
//! The number of eigenvalues between two shifts follows from the pivots of K - σM = LDLᵀ (Sylvester's law of inertia), and as many
//! must be found (Grimes, Lewis and Simon, *SIAM J. Matrix Anal. Appl.* 15, 228, 1994).

mod block;
mod dense;
mod error;
mod factor;
mod lanczos;
mod lifted;
mod memory;
mod panel;
mod pencil;
mod plan;
mod rayleigh;
mod shift_invert;
mod slicing;
mod small;
mod solve;
mod times;

#[cfg(test)]
mod tests;
pub(crate) use error::SpectrumError;
pub(crate) use lifted::lifted_works;
pub(crate) use memory::{estimate_bytes, seconds};
use pencil::Pencil;
use plan::Plan;
use rayon::prelude::*;
pub(crate) use times::{symmetric_times, works};
use unripple_core::Observed;
use unripple_linalg::Mat;
use unripple_linalg::sparse::SparseColMatRef;

/// Relative step by which a shift is moved if it coincides with an eigenvalue of the pencil or of a leading
/// part of it: some ten thousand rounding errors. With twice this value, a count may include eigenvalues up
/// to 1.4e-10 above the bound.
#[cfg(test)]
const NUDGE: f64 = 1e-11;
/// Number of unknowns up to which dense matrices are used. With twice this value, this includes meshes of up to 640, in up to eight
/// times the time that 320 take.
const SMALL: usize = 320;
/// Number of unknowns up to which dense matrices are used if Lanczos iteration misses eigenvectors of a multiple eigenvalue.
/// With twice this value, such a solution takes up to eight times as long.
const MEDIUM: usize = 1500;

/// Eigenpairs of K x = λ M x.
#[derive(Debug)]
pub(crate) struct Pairs {
    /// Eigenvalues λ, ascending.
    pub(crate) values: Vec<f64>,
    /// An eigenvector in each column, unknowns x pairs, XᵀMX = 1.
    pub(crate) vectors: Mat<f64>,
    /// Largest residual: the norm in M of (K - σM)⁻¹Mx - x/(λ-σ), times abs(λ-σ), with σ the shift at which
    /// the pair was found. The error of an eigenvalue, relative to its distance from σ, is the square of
    /// the residual over the relative gap of 1/(λ-σ); the error of its vector is the residual over that
    /// gap.
    pub(crate) residual: f64,
}

/// All eigenpairs with λ < `top`, for K positive semidefinite and M positive definite, both given with both
/// triangles. `observed` is notified of factorisations while shifts are placed, then of the share of the
/// eigenpairs that is computed.
///
/// # Errors
/// [`SpectrumError::Matrices`] unless both matrices are square, of equal size and finite, and M is positive definite;
/// [`SpectrumError::Factors`] if K - σM cannot be factorised; [`SpectrumError::Missed`] if the number of eigenpairs found is
/// not that given by inertia.
pub(crate) fn below(
    stiffness: SparseColMatRef<usize, f64>,
    mass: SparseColMatRef<usize, f64>,
    top: f64,
    observed: &Observed,
) -> Result<Pairs, SpectrumError> {
    check_bound(top)?;
    let pencil = Pencil::new(stiffness, mass)?;
    if top <= 0.0 {
        return Ok(Pairs { values: Vec::new(), vectors: Mat::zeros(pencil.len(), 0), residual: 0.0 });
    }
    let mut pieces = if pencil.len() <= SMALL {
        vec![dense::all(&pencil, top)?]
    } else {
        let found = Plan::new(&pencil, top, observed).and_then(|plan| slicing::all(&pencil, plan, observed));
        match found {
            Err(SpectrumError::Missed { .. }) if pencil.len() <= MEDIUM => vec![dense::all(&pencil, top)?],
            found => found?,
        }
    };
    pieces.par_iter_mut().for_each(|piece| piece.refine(&pencil));
    let residual = pieces.iter().flat_map(|p| &p.residuals).fold(0.0_f64, |a, b| a.max(*b));
    let (values, vectors) = block::gather(&pencil, &pieces, top);
    Ok(Pairs { values, vectors, residual })
}

#[cfg(test)]
/// Number of eigenvalues below σ, by the signs of the pivots of K - σM (Sylvester's law of inertia).
///
/// # Errors
/// As [`below`].
pub(crate) fn count_below(
    stiffness: SparseColMatRef<usize, f64>,
    mass: SparseColMatRef<usize, f64>,
    sigma: f64,
) -> Result<usize, SpectrumError> {
    check_bound(sigma)?;
    let pencil = Pencil::new(stiffness, mass)?;
    let factor = (0..8).find_map(|nudge| {
        let shift = sigma + nudge as f64 * NUDGE * sigma.abs().max(f64::MIN_POSITIVE);
        factor::Factor::new(&pencil, shift, unripple_linalg::Par::Seq).transpose()
    });
    factor.unwrap_or(Err(SpectrumError::Factors { shift: sigma })).map(|factor| factor.below)
}

fn check_bound(bound: f64) -> Result<(), SpectrumError> {
    if bound.is_finite() {
        return Ok(());
    }
    Err(SpectrumError::Matrices {
        what: "bound of eigenvalues",
        expected: "a finite number".to_owned(),
        found: bound.to_string(),
    })
}
