//! The derivative of a band-limited signal that is cut off at its ends.

use unripple_dsp::kaiser;
use unripple_linalg::{Cholesky, Lu, Mat};

/// Number of samples on each side from which a derivative is computed; with [`BETA`] its error is 1e-4 up
/// to 0.42 of the sample rate. With twice this value, this holds up to about 0.46, and twice as many
/// samples at each end need taps of their own.
const HALF: usize = 32;
/// Shape of the Kaiser window over these samples: side lobes below -110 dB. With twice this value, the band
/// in which the error is 1e-4 shrinks.
const BETA: f64 = 12.0;

/// Weight of the power of the taps (their response outside the band) against the error inside: it keeps taps near an end
/// small, and costs an error of 3e-4 at the very end of a signal that reaches a tenth of the rate. With twice this value, taps are a
/// little smaller and errors larger.
const OUTSIDE: f64 = 1e-9;

/// A differentiator for signals up to a given frequency.
///
/// A signal that was cut off is not zero beyond its ends: padded with zeros, it would have a step there, whose derivative is an impulse.
/// Within `HALF` samples of an end, the derivative is therefore computed only from samples that exist, by least-squares taps for the band.
#[derive(Clone, Debug)]
pub(super) struct Derivative {
    rate: f64,
    /// Taps away from the ends, for the samples after the current one; the taps for the samples before it
    /// have the opposite sign.
    inner: Vec<f64>,
    /// Taps near an end, for each number of samples before the current one; each list begins at the first
    /// sample of the signal.
    edge: Vec<Vec<f64>>,
}

impl Derivative {
    /// A differentiator for signals at `rate` samples per second with frequencies up to `top` (Hz).
    pub fn new(rate: f64, top: f64) -> Self {
        let tap = |k: usize| {
            let share = k as f64 / (HALF + 1) as f64;
            let window = kaiser(share, BETA);
            let sign = if k.is_multiple_of(2) { -1.0 } else { 1.0 };
            sign * window / k as f64
        };
        let top = std::f64::consts::TAU * (top / rate).clamp(1e-6, 0.5);
        Self {
            rate,
            inner: (1..=HALF).map(tap).collect(),
            edge: (0..HALF).map(|before| taps(before, HALF, top)).collect(),
        }
    }

    /// The derivative of a signal at each sample, in the signal's unit per second; a signal shorter than
    /// the taps is taken as zero beyond its ends.
    pub fn of(&self, signal: &[f64]) -> Vec<f64> {
        let last = signal.len().saturating_sub(1);
        let at = |i: Option<usize>| i.and_then(|i| signal.get(i)).copied().unwrap_or(0.0);
        let slope = |i: usize| -> f64 {
            let (before, after) = (i, last - i);
            let sum: f64 = if before < HALF && before <= after {
                self.edge[before].iter().zip(signal).map(|(tap, x)| tap * x).sum()
            } else if after < HALF {
                // Backwards in time, slopes have the other sign.
                -self.edge[after].iter().zip(signal.iter().rev()).map(|(tap, x)| tap * x).sum::<f64>()
            } else {
                let pair = |(k, tap): (usize, &f64)| tap * (at(Some(i + k + 1)) - at(i.checked_sub(k + 1)));
                self.inner.iter().enumerate().map(pair).sum()
            };
            self.rate * sum
        };
        (0..signal.len()).map(slope).collect()
    }
}

/// Taps for the derivative (per sample interval) at a sample, from `before` samples before it, the sample
/// and `after` samples after it.
///
/// They minimise ∫ |Σ t_j e^{iωj} - iω|² dω from 0 to `top`, so that Σ_k ∫ cos((j - k)ω) dω t_k = ∫ ω sin(jω) dω.
fn taps(before: usize, after: usize, top: f64) -> Vec<f64> {
    let count = before + after + 1;
    let place = |j: usize| j as f64 - before as f64;
    let even = |d: f64| if d == 0.0 { top } else { (d * top).sin() / d };
    let odd = |j: f64| if j == 0.0 { 0.0 } else { ((j * top).sin() - j * top * (j * top).cos()) / (j * j) };
    let matrix = Mat::from_fn(count, count, |j, k| {
        even(place(j) - place(k)) + if j == k { OUTSIDE * top } else { 0.0 }
    });
    let mut found = Mat::from_fn(count, 1, |j, _| odd(place(j)));
    match Cholesky::new(matrix.as_ref()) {
        Some(factor) => factor.solve(found.as_mut()),
        None => Lu::new(matrix.as_ref()).solve(found.as_mut()),
    }
    found.col(0).iter().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Largest errors over ω in the middle and within `HALF` samples of the ends, of tones cut anywhere.
    fn errors(top: f64, share: f64) -> [f64; 2] {
        let derivative = Derivative::new(1.0, top);
        let mut found = [0.0_f64; 2];
        for phase in [0.0, 0.7, 1.4] {
            let tone = |i: usize| TAU * share * i as f64 + phase;
            let signal: Vec<f64> = (0..400).map(|i| tone(i).sin()).collect();
            for (i, slope) in derivative.of(&signal).iter().enumerate() {
                let end = usize::from(!(HALF..400 - HALF).contains(&i));
                let error = (slope - TAU * share * tone(i).cos()).abs();
                found[end] = found[end].max(error / (TAU * share.max(0.05)));
            }
        }
        found
    }

    #[test]
    fn derivatives_are_right_nearly_up_to_half_the_rate() {
        for share in [0.01, 0.2, 0.42] {
            assert!(errors(0.42, share)[0] < 2e-3, "{share}: {:?}", errors(0.42, share));
        }
    }

    #[test]
    fn derivatives_are_right_at_the_ends_of_signals_that_were_cut() {
        for top in [0.01, 0.0375, 0.1, 0.2] {
            for share in [0.1 * top, 0.5 * top, top] {
                assert!(errors(top, share)[1] < 2e-3, "{top} {share}: {:?}", errors(top, share));
            }
        }
    }

    #[test]
    fn short_signals_have_derivatives_too() {
        let derivative = Derivative::new(1.0, 0.1);
        for length in [0, 1, 2, 33, 50] {
            let found = derivative.of(&vec![1.0; length]);
            assert!(found.len() == length && found.iter().all(|x| x.is_finite()), "{length}: {found:?}");
        }
    }
}
