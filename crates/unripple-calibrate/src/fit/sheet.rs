//! The bare sheet at some values of the unknowns: a Ritz combination of the nominal modes.

use super::basis::Basis;
use super::layout::{Values, around};
use crate::CalibrateError;
use std::f64::consts::TAU;
use unripple_linalg::{Mat, symmetric};

/// The bare sheet at some values of the unknowns, without loads: its modes as combinations of the nominal ones.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// Squares of the natural frequencies, in (rad/s)².
    pub squares: Vec<f64>,
    /// Decay rates of the modes, in 1/s.
    pub sigmas: Vec<f64>,
    /// The sheet's modes as combinations of the nominal ones, a column for each: nominal modes x modes.
    pub turn: Mat<f64>,
    /// Stiffness due to tension, nominal modes x nominal modes, in (rad/s)².
    pub tension: Mat<f64>,
    /// Stiffness due to bending, nominal modes x nominal modes, in (rad/s)².
    pub bending: Mat<f64>,
}

impl Sheet {
    /// The sheet for `values` of the unknowns, computed from the first `count` nominal modes; `top` is the
    /// top of the band in Hz.
    ///
    /// In coordinates of the nominal modes the stiffness is Ω² + ΔK. Its eigenvectors are the new modes,
    /// exact but for the nominal modes that are left out.
    pub fn new(basis: &Basis, values: &Values, count: usize, top: f64) -> Result<Self, CalibrateError> {
        let part = |all: &Mat<f64>| all.submatrix(0, 0, count, count).to_owned();
        let nominal = part(&basis.tension);
        let mut bending = -&nominal;
        (0..count).for_each(|m| bending[(m, m)] += basis.squares[m]);
        let mut tension = nominal + values.skew * part(&basis.skew);
        for (term, share) in basis.terms.iter().zip(&values.profile).filter(|(_, share)| **share != 0.0) {
            tension += *share * term.submatrix(0, 0, count, count);
        }
        let (tension, bending) = (values.tension.exp() * tension, values.bending.exp() * bending);
        let (squares, turn) = eigen(&(&tension + &bending))?;
        let sigmas =
            squares.iter().map(|square| decay_rate(&values.knots, square.max(0.0).sqrt(), top)).collect();
        Ok(Self { squares, sigmas, turn, tension, bending })
    }
}

/// Decay rate (1/s) at an angular frequency (rad/s), interpolated between its logarithms `knots`; `top` is the top of the band
/// in Hz.
pub(super) fn decay_rate(knots: &[f64], omega: f64, top: f64) -> f64 {
    around(omega / (TAU * top)).iter().map(|(k, w)| w * knots[*k]).sum::<f64>().exp()
}

/// Eigenvalues, ascending, and eigenvectors of a symmetric matrix.
pub(super) fn eigen(matrix: &Mat<f64>) -> Result<(Vec<f64>, Mat<f64>), CalibrateError> {
    let failed = |found: String| CalibrateError::Unsolvable {
        what: "stiffness of the fitted sheet",
        expected: "positive eigenvalues",
        found,
    };
    let no_end = || failed("an iteration that does not converge".into());
    let (values, vectors) = symmetric(matrix.as_ref()).ok_or_else(no_end)?;
    match values.iter().all(|v| v.is_finite()) {
        true => Ok((values, vectors)),
        false => Err(failed("values that are not finite".into())),
    }
}
