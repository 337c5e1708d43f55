//! How well predicted signals agree with recorded ones, but for a gain and a delay that all share.

use super::lines::{Lines, Spectrum};
use unripple_dsp::Complex;

/// Steps of Newton's method from the whole sample with the largest correlation to the maximum between samples: it
/// converges quadratically, and half as many already reach 1e-4 of a sample.
const STEPS: usize = 6;

/// Agreement of recorded and predicted signals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Agreement {
    /// Factor on the prediction, negative for a reversed probe.
    pub gain: f64,
    /// Delay of the recordings, in samples.
    pub delay: f64,
    /// Energy of the recordings in the band: the sum of their squares over all samples.
    pub total: f64,
    /// Part of that energy that is left unexplained.
    pub left: f64,
}

impl Agreement {
    /// Finds gain and delay by least squares over all places.
    pub fn of(lines: &Lines, heard: &[Spectrum], predicted: &[Spectrum]) -> Self {
        let energy = |all: &[Spectrum]| all.iter().flatten().map(Complex::norm_sqr).sum::<f64>();
        let (total, known) = (energy(heard), energy(predicted));
        let mut cross = vec![Complex::default(); lines.count()];
        for (heard, predicted) in heard.iter().zip(predicted) {
            cross.iter_mut().zip(heard).zip(predicted).for_each(|((to, y), x)| *to += y * x.conj());
        }
        if known <= 0.0 || total <= 0.0 {
            return Self { total, left: total, ..Self::default() };
        }
        let delay = latest(lines, &cross);
        let correlation = slopes(lines, &cross, delay)[0];
        let left = (total - correlation * correlation / known).max(0.0);
        Self { gain: correlation / known, delay, total, left }
    }

    /// Amplitude that is left unexplained, as a share of that of the recordings.
    pub fn share(&self) -> f64 {
        if self.total > 0.0 { (self.left / self.total).sqrt() } else { 0.0 }
    }
}

/// The delay of the largest correlation, of either sign, in samples.
fn latest(lines: &Lines, cross: &[Complex<f64>]) -> f64 {
    let correlation = lines.signal(cross);
    let peak = correlation.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (at, size) = (peak.map_or(0, |(at, _)| at), correlation.len());
    let whole = if 2 * at > size { at as f64 - size as f64 } else { at as f64 };
    let mut delay = whole;
    for _ in 0..STEPS {
        let [value, first, second] = slopes(lines, cross, delay);
        // Towards the maximum of the magnitude alone, and not beyond the next sample.
        if value * second >= 0.0 {
            break;
        }
        delay = (delay - first / second).clamp(whole - 1.0, whole + 1.0);
    }
    delay
}

/// The correlation at a delay (samples), and its first and second derivative.
fn slopes(lines: &Lines, cross: &[Complex<f64>], delay: f64) -> [f64; 3] {
    cross.iter().enumerate().fold([0.0; 3], |[value, first, second], (line, x)| {
        let turn = lines.turn(line);
        let turned = x * Complex::cis(turn * delay);
        [value + turned.re, first - turn * turned.im, second - turn * turn * turned.re]
    })
}
