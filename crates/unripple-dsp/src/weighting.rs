//! Displacement weighted by the vibrotactile detection threshold.

use crate::FourierPlanner;
use crate::Threshold;
use crate::convolve::smooth_size;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealToComplex};
use std::sync::Arc;

/// A zero-phase filter that weights displacements by 1/threshold(f): its output is in units of the detection threshold, and has
/// amplitude 1 for a steady sine that is just felt.
///
/// Each bin of a Fourier transform is multiplied by a real gain, so that the filter has no delay and keeps all phases. The
/// transform is circular. The plan is immutable and can be shared between threads.
///
/// ```
/// use unripple_dsp::{Threshold, Weighting};
///
/// // Five periods of 250 Hz, 10 times (20 dB) above its threshold of 0.1 µm.
/// let sine: Vec<f64> = (0..960).map(|i| 1e-6 * (std::f64::consts::TAU * 250.0 * f64::from(i) / 48e3).sin()).collect();
/// let felt = Weighting::periodic(&Threshold::default(), 48e3, 960).weigh(&sine);
/// assert!(sine.iter().zip(&felt).all(|(u, w)| (1e7 * u - w).abs() < 1e-6));
/// ```
#[derive(Clone)]
pub struct Weighting {
    size: usize,
    /// Gain of each bin, divided by the size of the transform.
    gains: Vec<f64>,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

impl std::fmt::Debug for Weighting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Weighting").field("size", &self.size).finish()
    }
}

impl Weighting {
    /// A plan for signals of at most `samples` samples, at `rate` samples per second, that are zero before
    /// and after. They are padded with at least `rest` zeros, up to the next size whose prime factors are
    /// 2, 3 and 5, to keep the two ends of the circular transform apart.
    pub fn padded(threshold: &Threshold, rate: f64, samples: usize, rest: usize) -> Self {
        Self::of(threshold, rate, smooth_size(samples.saturating_add(rest).max(1)))
    }

    /// A plan for periodic signals with a period of exactly `samples` samples, at `rate` samples per second.
    pub fn periodic(threshold: &Threshold, rate: f64, samples: usize) -> Self {
        Self::of(threshold, rate, samples.max(1))
    }

    /// A plan for a transform of `size` samples: the gain of each bin is 1/threshold at its frequency.
    fn of(threshold: &Threshold, rate: f64, size: usize) -> Self {
        let mut planner = FourierPlanner::new();
        let gain = |line: usize| 1.0 / (threshold.at(line as f64 * rate / size as f64) * size as f64);
        Self {
            size,
            gains: (0..=size / 2).map(gain).collect(),
            forward: planner.forward(size),
            inverse: planner.inverse(size),
        }
    }

    /// Number of samples of the Fourier transform.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Filters a displacement (m): the result is in units of the threshold (dimensionless), with as many samples as the
    /// displacement. Samples beyond the size of the transform are left out.
    pub fn weigh(&self, displacement: &[f64]) -> Vec<f64> {
        let length = displacement.len().min(self.size);
        let mut signal = self.forward.make_input_vec();
        signal[..length].copy_from_slice(&displacement[..length]);
        let mut spectrum = self.forward.make_output_vec();
        let done = self.forward.process(&mut signal, &mut spectrum);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
        spectrum.iter_mut().zip(&self.gains).for_each(|(line, gain)| *line *= gain);
        real_ends(&mut spectrum, self.size);
        let done = self.inverse.process(&mut spectrum, &mut signal);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
        signal.truncate(length);
        signal
    }
}

/// Makes the bins at 0 and at half the rate real, as those of a real signal are; rounding may leave a small imaginary part.
fn real_ends(spectrum: &mut [Complex<f64>], size: usize) {
    if let Some(first) = spectrum.first_mut() {
        first.im = 0.0;
    }
    if let Some(last) = spectrum.last_mut().filter(|_| size.is_multiple_of(2)) {
        last.im = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn level(signal: &[f64]) -> f64 {
        20.0 * signal.iter().fold(0.0, |m: f64, x| m.max(x.abs())).log10()
    }

    /// Sines of 1 µm at their own level above the published threshold.
    #[test]
    fn a_sine_has_its_level() {
        let rate = 48e3;
        for (hz, expected) in
            [(250.0, 20.0), (40.0, -10.0), (20.0, -10.0), (500.0, 10.457_575), (1000.0, -9.542_425)]
        {
            let sine: Vec<f64> =
                (0..24_000).map(|i| 1e-6 * (TAU * hz * f64::from(i) / rate + 0.3).sin()).collect();
            let periodic = level(&Weighting::periodic(&Threshold::default(), rate, 24_000).weigh(&sine));
            assert!((periodic - expected).abs() < 0.01, "{hz}: {periodic}");
        }
    }

    /// Half a second of a sine, padded with zeros, has its level away from its ends. This does not hold at frequencies of high
    /// threshold, where the click at the ends is felt more than the sine and decays slowly.
    #[test]
    fn rest_on_either_side_is_felt_at_the_ends_only() {
        let sine: Vec<f64> = (0..24_000).map(|i| 1e-6 * (TAU * 250.0 * f64::from(i) / 48e3).sin()).collect();
        let felt = Weighting::padded(&Threshold::default(), 48e3, 24_000, 8_000).weigh(&sine);
        assert!((level(&felt[8_000..16_000]) - 20.0).abs() < 0.01, "{}", level(&felt[8_000..16_000]));
    }

    /// The sum that defines a Fourier transform, with the gain line by line.
    fn slow(threshold: &Threshold, rate: f64, size: usize, signal: &[f64]) -> Vec<f64> {
        let kernel: Vec<f64> = (0..size)
            .map(|shift| {
                let line = |k: usize| {
                    let hz = k.min(size - k) as f64 * rate / size as f64;
                    (TAU * ((k * shift) % size) as f64 / size as f64).cos() / threshold.at(hz)
                };
                (0..size).map(line).sum::<f64>() / size as f64
            })
            .collect();
        (0..signal.len())
            .map(|i| (0..signal.len()).map(|j| kernel[(size + i - j) % size] * signal[j]).sum())
            .collect()
    }

    proptest! {
        #[test]
        fn is_the_sum_that_defines_it(
            signal in prop::collection::vec(-1e-6..1e-6_f64, 1..60), rest in 0usize..40, rate in 200.0..9e3_f64,
        ) {
            let threshold = Threshold::default();
            let plans = [
                Weighting::padded(&threshold, rate, signal.len(), rest),
                Weighting::periodic(&threshold, rate, signal.len()),
            ];
            prop_assert!(plans[0].size() >= signal.len() + rest);
            prop_assert_eq!(plans[1].size(), signal.len());
            for plan in plans {
                for (found, expected) in plan.weigh(&signal).iter().zip(slow(&threshold, rate, plan.size(), &signal)) {
                    prop_assert!((found - expected).abs() < 1e-10, "{} {}", found, expected);
                }
            }
        }

        #[test]
        fn does_not_shift_in_time(signal in prop::collection::vec(-1e-6..1e-6_f64, 64)) {
            let plan = Weighting::periodic(&Threshold::default(), 4e3, 64);
            let backwards: Vec<f64> = signal.iter().rev().copied().collect();
            let (one, mut other) = (plan.weigh(&signal), plan.weigh(&backwards));
            other.reverse();
            for (a, b) in one.iter().zip(&other) {
                prop_assert!((a - b).abs() < 1e-10, "{} {}", a, b);
            }
        }
    }

    #[test]
    fn signals_of_any_length_are_taken() {
        let plan = Weighting::padded(&Threshold::default(), 48e3, 0, 0);
        assert!(plan.weigh(&[]).is_empty());
        assert_eq!(Weighting::periodic(&Threshold::default(), 48e3, 0).weigh(&[1e-6]).len(), 1);
        assert_eq!(Weighting::periodic(&Threshold::default(), 48e3, 7).weigh(&[1e-6; 20]).len(), 7);
    }
}
