//! Resampling of signals: to another sample rate, or to another clock.

use crate::{kaiser, sinc};

/// Number of zeros of the sinc on each side. With [`BETA`] the transition band reaches 5 % of the rate to
/// each side of half the rate; with twice as many zeros, it is half as wide for twice the multiplications.
const ZEROS: usize = 48;

/// Shape of the Kaiser window: side lobes below -110 dB. With twice this value, they would sink below what float32 files
/// hold, for a transition about twice as wide.
const BETA: f64 = 11.5;

/// Entries of the kernel's table from one zero to the next. Interpolated linearly, it is exact within 1e-7; doubled, within
/// a quarter of that.
const STEPS: usize = 2048;

/// Resamples a signal: output sample `i` is the signal at the (fractional) sample index `i · step`, up to the signal's end.
///
/// `step` is the old sample rate over the new one: 44100/48000 converts 44.1 kHz to 48 kHz, 1 + 43e-6 corrects a recording whose clock
/// ran 43 ppm fast. The result is empty if `step` is not positive and finite.
///
/// Kaiser-windowed sinc interpolation (J. O. Smith, *Digital Audio Resampling*), exact within 1e-5 for signals up to 0.9 of half the
/// lower of both rates. Frequencies that would alias are removed. The signal counts as zero beyond its ends.
///
/// ```
/// let tone = |rate: f64, i: usize| (std::f64::consts::TAU * 1000.0 * i as f64 / rate).sin();
/// let at_44: Vec<f64> = (0..4410).map(|i| tone(44.1e3, i)).collect();
/// let at_48 = unripple_dsp::resample(&at_44, 44.1 / 48.0);
/// assert_eq!(at_48.len(), 4800);
/// assert!((200..4600).all(|i| (at_48[i] - tone(48e3, i)).abs() < 1e-5));
/// ```
pub fn resample(signal: &[f64], step: f64) -> Vec<f64> {
    if !step.is_finite() || step <= 0.0 || signal.is_empty() {
        return Vec::new();
    }
    // For a lower output rate the kernel is stretched, which lowers its cut-off; its sum stays one.
    let cut = step.recip().min(1.0);
    let table: Vec<f64> = (0..=ZEROS * STEPS + 1)
        .map(|i| {
            let t = i as f64 / STEPS as f64;
            cut * sinc(t) * kaiser(t / ZEROS as f64, BETA)
        })
        .collect();
    let kernel = |distance: f64| {
        let at = distance.abs() * cut * STEPS as f64;
        let (whole, part) = (at as usize, at.fract());
        match table.get(whole..whole + 2) {
            Some([low, high]) => low + part * (high - low),
            _ => 0.0,
        }
    };
    let reach = ZEROS as f64 / cut;
    // Slightly less, so that rounding of the quotient adds no sample.
    let count = ((signal.len() as f64 / step) - 1e-9).ceil().max(0.0) as usize;
    let sample = |i: usize| {
        let at = i as f64 * step;
        let first = (at - reach).ceil().max(0.0) as usize;
        let last = ((at + reach).floor() as usize).min(signal.len() - 1);
        (first..=last).map(|k| signal[k] * kernel(at - k as f64)).sum()
    };
    (0..count).map(sample).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn tone(hz: f64, rate: f64, count: usize) -> Vec<f64> {
        (0..count).map(|i| (TAU * hz * i as f64 / rate).sin()).collect()
    }

    #[test]
    fn tones_come_out_as_they_were_sampled_there() {
        for (from, to) in [(44.1e3, 48e3), (96e3, 48e3), (48e3, 48e3 / (1.0 + 2e-4)), (48e3, 44.1e3)] {
            let top = f64::min(from, to) / 2.0;
            for hz in [50.0, 1e3, 0.5 * top, 0.9 * top] {
                let made = resample(&tone(hz, from, 9600), from / to);
                let wanted = tone(hz, to, made.len());
                let worst = (300..made.len() - 300).map(|i| (made[i] - wanted[i]).abs()).fold(0.0, f64::max);
                assert!(worst < 1e-5, "{from} to {to} at {hz} Hz: {worst:.2e}");
            }
        }
    }

    #[test]
    fn what_would_fold_is_taken_out() {
        let made = resample(&tone(30e3, 96e3, 9600), 2.0);
        let worst = made[300..made.len() - 300].iter().fold(0.0, |worst: f64, x| worst.max(x.abs()));
        assert!(worst < 1e-5, "{worst:.2e}");
    }

    #[test]
    fn nonsense_gives_nothing() {
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(resample(&[1.0; 8], step).is_empty());
        }
        assert!(resample(&[], 1.0).is_empty());
        let same = resample(&[1.0, -2.0, 3.0], 1.0);
        assert!(same.iter().zip([1.0, -2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{same:?}");
    }
}
