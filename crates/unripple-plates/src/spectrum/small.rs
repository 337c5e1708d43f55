//! Small Gram matrices between blocks of vectors, and their Cholesky factors.

use super::error::{SpectrumError, indefinite};
use super::panel::{LANES, NONE, Square};

/// Least pivot, above rounding errors, of a Gram matrix with ones on its diagonal: smaller pivots are
/// raised to this value, so that R has an inverse.
const LEAST: f64 = 1e-14;

/// The identity matrix, ones on the diagonal.
pub(super) fn identity() -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j)))
}

/// The transposed matrix, rows and columns exchanged.
pub(super) fn transposed(a: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

/// The matrix product A B.
pub(super) fn product(a: &Square, b: &Square) -> Square {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..LANES).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The Cholesky factor R of a Gram matrix RᵀR, and its inverse.
pub(super) struct Triangle {
    /// The upper triangle R.
    pub(super) upper: Square,
    /// Inverse R⁻¹ of the upper triangle.
    pub(super) inverse: Square,
    /// Ratio of the least to the largest pivot, with the diagonal scaled to one; pivots below [`LEAST`] are
    /// raised to that value.
    pub(super) ratio: f64,
}

impl Triangle {
    /// The Cholesky factorisation of a Gram matrix.
    ///
    /// # Errors
    /// [`SpectrumError::Matrices`] if the diagonal is not positive.
    pub(super) fn of(gram: &Square) -> Result<Self, SpectrumError> {
        let mut upper = [NONE; LANES];
        let mut ratio = 1.0_f64;
        for j in 0..LANES {
            let square = gram[j][j];
            if !(square > 0.0 && square.is_finite()) {
                return Err(indefinite(square));
            }
            for i in 0..j {
                let done: f64 = (0..i).map(|k| upper[k][i] * upper[k][j]).sum();
                upper[i][j] = (gram[i][j] - done) / upper[i][i];
            }
            let done: f64 = (0..j).map(|k| upper[k][j] * upper[k][j]).sum();
            let pivot = ((square - done) / square).max(LEAST);
            ratio = ratio.min(pivot);
            upper[j][j] = (pivot * square).sqrt();
        }
        let mut inverse = [NONE; LANES];
        for j in 0..LANES {
            inverse[j][j] = 1.0 / upper[j][j];
            for i in (0..j).rev() {
                let sum: f64 = (i + 1..=j).map(|k| upper[i][k] * inverse[k][j]).sum();
                inverse[i][j] = -sum / upper[i][i];
            }
        }
        Ok(Self { upper, inverse, ratio })
    }
}
