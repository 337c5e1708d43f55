//! All eigenpairs below a bound of a sparse symmetric pencil K x = λ M x, none missed.
//!
//! The spectrum is cut by shifts; at each, block Lanczos on (K - σM)⁻¹M finds the eigenpairs nearest to it on both sides.
//! How many there are between two shifts is told by the pivots of K - σM = LDLᵀ (Sylvester's law of inertia), and what is
//! found must make up that number (Grimes, Lewis and Simon, *SIAM J. Matrix Anal. Appl.* 15, 228, 1994).

mod block;
mod dense;
mod error;
mod factor;
mod lanczos;
mod memory;
mod panel;
mod pencil;
mod plan;
mod rayleigh;
mod shift_invert;
mod slicing;
mod small;
mod solve;

#[cfg(test)]
mod tests;
pub(crate) use error::SpectrumError;
pub(crate) use memory::estimate_bytes;
use pencil::Pencil;
use plan::Plan;
use rayon::prelude::*;
use unripple_linalg::Mat;
use unripple_linalg::sparse::SparseColMatRef;

/// Relative step by which a shift moves that meets an eigenvalue of K or of a part of it: some ten thousand
/// roundings. Doubled, a count may take in eigenvalues up to 1.4e-10 above the bound.
#[cfg(test)]
const NUDGE: f64 = 1e-11;
/// Unknowns up to which matrices are taken as dense. Doubled, so are meshes of up to 640, in up to eight
/// times the time that 320 take.
const SMALL: usize = 320;
/// Unknowns up to which they are if an eigenvalue has more vectors than the iteration can tell apart.
/// Doubled, such a solution takes up to eight times as long.
const MEDIUM: usize = 1500;

/// Eigenpairs of K x = λ M x.
#[derive(Debug)]
pub(crate) struct Pairs {
    /// Eigenvalues λ, ascending.
    pub(crate) values: Vec<f64>,
    /// An eigenvector in each column, unknowns x pairs, XᵀMX = 1.
    pub(crate) vectors: Mat<f64>,
    /// Largest norm in M of (K - σM)⁻¹Mx - x/(λ-σ), times abs(λ-σ), σ the shift that the pair was found from. Relative to
    /// its distance from σ, an eigenvalue's error is the square of this over the relative gap of its inverse; that of its
    /// vector is this over that gap.
    pub(crate) residual: f64,
}

/// All eigenpairs with λ < `top`, K semidefinite and M positive definite, both given with both triangles.
///
/// # Errors
/// [`SpectrumError::Matrices`] unless both matrices are square, alike in size, finite, and M is positive definite;
/// [`SpectrumError::Factors`] where K - σM cannot be factorised; [`SpectrumError::Missed`] if the number of eigenpairs is
/// not that proved by inertia.
pub(crate) fn below(
    stiffness: SparseColMatRef<usize, f64>,
    mass: SparseColMatRef<usize, f64>,
    top: f64,
) -> Result<Pairs, SpectrumError> {
    check_bound(top)?;
    let pencil = Pencil::new(stiffness, mass)?;
    if top <= 0.0 {
        return Ok(Pairs { values: Vec::new(), vectors: Mat::zeros(pencil.len(), 0), residual: 0.0 });
    }
    let mut pieces = if pencil.len() <= SMALL {
        vec![dense::all(&pencil, top)?]
    } else {
        let found = Plan::new(&pencil, top).and_then(|plan| slicing::all(&pencil, plan));
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
