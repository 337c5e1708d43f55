//! Time reversal to every point at once, in modal coordinates.

use crate::core::ModalResponses;
use rayon::prelude::*;
use unripple_dsp::Correlations;
use unripple_linalg::{Mat, product};

/// The matrix G (modes x modes): from the shape weights at a target to the velocity of every mode at the focal instant
/// of time reversal over `samples` samples, up to a common factor.
pub(super) fn map(modal: &ModalResponses, samples: usize) -> Mat<f64> {
    let (poles, rate) = (&modal.poles, modal.conditions.rate);
    let sums = Correlations::new(poles, rate, samples);
    let inputs = product(modal.input.transpose(), modal.input.as_ref());
    let modes = poles.len();
    let rows: Vec<Vec<f64>> = (0..modes)
        .into_par_iter()
        .map(|i| (0..=i).map(|j| inputs[(i, j)] * sums.of(i, j)).collect())
        .collect();
    Mat::from_fn(modes, modes, |i, j| rows[i.max(j)][i.min(j)])
}
