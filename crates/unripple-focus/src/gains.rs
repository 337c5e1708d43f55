//! Gains of reversed responses that give every focus its prescribed level, from a small linear system.

use crate::FocusError;
use crate::recording::Recording;
use unripple_core::{OutOfRange, require};
use unripple_linalg::{Cholesky, Mat};

/// Gains of reversed responses that give every focus its prescribed level, including the motion that foci
/// cause at each other.
///
/// Response k is played backwards so that its sample 0 falls on `instants[k]`, over samples 0 and later of the drive. The velocity
/// at focus k is then `Σ_l G_kl c_l / rate` with `G_kl = Σ_a Σ_j h_ak[f_k − j] h_al[f_l − j]`, the Gram matrix of the reversed
/// responses, so that the drive `Σ_k c_k h_ak[f_k − j]` is the one of least energy among all that reach these levels. `ridge`,
/// as a share of the mean of the diagonal, keeps foci finite that lie too close to differ (Tikhonov
/// regularisation); recordings hold `[actuator][sample]` with as many samples each.
///
/// # Errors
/// [`FocusError::Range`] where no finite gains meet the levels.
pub(crate) fn gains(
    recordings: &[Recording],
    instants: &[usize],
    levels: &[f64],
    (ports, rate): (usize, f64),
    ridge: f64,
) -> Result<Vec<f64>, FocusError> {
    let count = recordings.len();
    let length = |k: usize| recordings[k].samples.len() / ports.max(1);
    let mut gram = Mat::<f64>::zeros(count, count);
    for k in 0..count {
        for l in 0..=k {
            let (early, late) = if instants[k] < instants[l] { (k, l) } else { (l, k) };
            let delay = instants[late] - instants[early];
            let ages = (instants[early] + 1).min(length(early)).min(length(late).saturating_sub(delay));
            let of = |i: usize| recordings[i].samples.chunks_exact(length(i).max(1));
            let meet = of(early).zip(of(late)).map(|(a, b)| dot(&a[..ages], &b[delay.min(b.len())..]));
            let sum: f64 = meet.sum();
            (gram[(k, l)], gram[(l, k)]) = (sum, sum);
        }
    }
    let mean = (0..count).map(|k| gram[(k, k)]).sum::<f64>() / count.max(1) as f64;
    (0..count).for_each(|k| gram[(k, k)] += ridge * mean);
    let mut found = Mat::from_fn(count, 1, |k, _| levels[k] * rate);
    let unreachable = || "foci far enough apart for their levels to differ, or a larger ridge".to_owned();
    let Some(factors) = Cholesky::new(gram.as_ref()) else {
        return Err(FocusError::Range(OutOfRange::new("ridge", unreachable(), ridge)));
    };
    factors.solve(found.as_mut());
    let gains: Vec<f64> = (0..count).map(|k| found[(k, 0)]).collect();
    require("ridge", gains.iter().all(|c| c.is_finite()), unreachable(), ridge)?;
    Ok(gains)
}

/// The sum Σab over the length of the shorter slice, in eight independent partial sums.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let length = a.len().min(b.len());
    let (a, b) = (&a[..length], &b[..length]);
    let mut sums = [0.0; 8];
    let whole = a.chunks_exact(8).zip(b.chunks_exact(8));
    whole.for_each(|(a, b)| sums.iter_mut().zip(a.iter().zip(b)).for_each(|(s, (a, b))| *s += a * b));
    let rest = length / 8 * 8;
    let tail: f64 = a[rest..].iter().zip(&b[rest..]).map(|(a, b)| a * b).sum();
    tail + sums.iter().sum::<f64>()
}
