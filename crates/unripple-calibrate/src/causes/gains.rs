//! The gain of each actuator that explains the recordings best, by least squares.

use super::agreement::Agreement;
use super::lines::Spectrum;
use super::model::Model;
use unripple_dsp::Complex;
use unripple_linalg::{Cholesky, Mat};

/// Regularisation relative to the mean power of the contributions: it keeps the gain of an actuator that contributes nothing
/// finite, and moves others by a millionth.
const RIDGE: f64 = 1e-6;

/// The least-squares gain of each actuator, at the delay of `known`, and the agreement with these gains, whose own gain is 1;
/// `None` where nothing is predicted.
pub(super) fn search(
    model: &Model,
    heard: &[Spectrum],
    responses: &[Spectrum],
    drive: &[Spectrum],
    known: &Agreement,
) -> Option<(Vec<f64>, Agreement)> {
    let (count, lines) = (model.actuators(), model.lines());
    let turned: Vec<Complex<f64>> =
        (0..lines.count()).map(|line| Complex::cis(lines.turn(line) * known.delay)).collect();
    let (mut gram, mut right) = (Mat::<f64>::zeros(count, count), Mat::<f64>::zeros(count, 1));
    for (heard, own) in heard.iter().zip(responses.chunks_exact(count)) {
        let parts: Vec<Spectrum> =
            own.iter().zip(drive).map(|(h, d)| h.iter().zip(d).map(|(h, d)| h * d).collect()).collect();
        let dot = |x: &Spectrum, y: &dyn Fn(usize) -> Complex<f64>| -> f64 {
            x.iter().enumerate().map(|(line, x)| (x.conj() * y(line)).re).sum()
        };
        for (a, part) in parts.iter().enumerate() {
            right[(a, 0)] += dot(part, &|line| heard[line] * turned[line]);
            for (b, other) in parts.iter().enumerate().take(a + 1) {
                gram[(a, b)] += dot(part, &|line| other[line]);
            }
        }
    }
    let mean = (0..count).map(|a| gram[(a, a)]).sum::<f64>() / count.max(1) as f64;
    let plain = gram.clone();
    (0..count).for_each(|a| gram[(a, a)] += RIDGE * mean);
    let mut gains = right.clone();
    Cholesky::new(gram.as_ref())?.solve(gains.as_mut());
    let gain = |a: usize| gains[(a, 0)];
    let explained: f64 = (0..count).map(|a| 2.0 * gain(a) * right[(a, 0)]).sum();
    let squares: f64 = (0..count)
        .flat_map(|a| (0..count).map(move |b| (a, b)))
        .map(|(a, b)| gain(a) * gain(b) * plain[(a.max(b), a.min(b))])
        .sum();
    let left = (known.total - explained + squares).max(0.0);
    let gains: Vec<f64> = (0..count).map(gain).collect();
    gains.iter().all(|gain| gain.is_finite()).then_some((gains, Agreement { gain: 1.0, left, ..*known }))
}
