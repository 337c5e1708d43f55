//! Linear convolution by fast Fourier transforms.

use crate::FourierPlanner;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealToComplex};
use std::sync::Arc;

/// A plan for linear convolutions whose results have at most `samples` samples.
///
/// Each signal is transformed once; the caller multiplies and sums spectra and transforms the result back once. The plan is
/// immutable and can be shared between threads.
///
/// ```
/// use unripple_dsp::Convolver;
///
/// let plan = Convolver::new(4);
/// let mut product = plan.spectrum([1.0, 2.0, 3.0]);
/// product.iter_mut().zip(plan.spectrum([1.0, -1.0])).for_each(|(a, b)| *a *= b);
/// let signal = plan.signal(product);
/// assert!(signal.iter().zip([1.0, 1.0, 1.0, -3.0]).all(|(a, b)| (a - b).abs() < 1e-12));
/// ```
pub struct Convolver {
    size: usize,
    samples: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

impl std::fmt::Debug for Convolver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Convolver").field("size", &self.size).field("samples", &self.samples).finish()
    }
}

impl Convolver {
    /// A plan for convolutions whose results have at most `samples` samples: a + b − 1 for signals of
    /// lengths a and b. With fewer, the convolution can become circular.
    pub fn new(samples: usize) -> Self {
        let size = smooth_size(samples.max(1));
        let mut planner = FourierPlanner::new();
        Self { size, samples, forward: planner.forward(size), inverse: planner.inverse(size) }
    }

    /// Number of samples N of the Fourier transform: at least the number of samples passed to
    /// [`Convolver::new`].
    pub fn size(&self) -> usize {
        self.size
    }

    /// Spectrum of a signal: bins 0 to N/2, with N of [`Convolver::size`], not normalised. The signal is padded with zeros to N
    /// samples; samples beyond N are ignored.
    pub fn spectrum(&self, signal: impl IntoIterator<Item = f64>) -> Vec<Complex<f64>> {
        let mut padded = self.forward.make_input_vec();
        padded.iter_mut().zip(signal).for_each(|(to, from)| *to = from);
        let mut spectrum = self.forward.make_output_vec();
        let done = self.forward.process(&mut padded, &mut spectrum);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
        spectrum
    }

    /// The signal with a given spectrum, cut to the number of samples that the plan was made for. All zeros if the spectrum does
    /// not have N/2 + 1 bins.
    pub fn signal(&self, mut spectrum: Vec<Complex<f64>>) -> Vec<f64> {
        let mut signal = self.inverse.make_output_vec();
        if let Some(first) = spectrum.first_mut() {
            first.im = 0.0;
        }
        if let Some(last) = spectrum.last_mut().filter(|_| self.size.is_multiple_of(2)) {
            last.im = 0.0;
        }
        if self.inverse.process(&mut spectrum, &mut signal).is_err() {
            signal.fill(0.0);
        }
        let scale = 1.0 / self.size as f64;
        signal.iter_mut().for_each(|x| *x *= scale);
        signal.truncate(self.samples);
        signal
    }
}

/// Linear convolution of two signals through the Fourier transform: lengths a and b give a + b − 1 samples.
///
/// ```
/// let y = unripple_dsp::convolve(&[1.0, 2.0], &[1.0, 0.0, -1.0]);
/// assert!(y.iter().zip([1.0, 2.0, -1.0, -2.0]).all(|(a, b)| (a - b).abs() < 1e-12));
/// ```
pub fn convolve(signal: &[f64], response: &[f64]) -> Vec<f64> {
    if signal.is_empty() || response.is_empty() {
        return Vec::new();
    }
    let plan = Convolver::new(signal.len() + response.len() - 1);
    let mut product = plan.spectrum(signal.iter().copied());
    product.iter_mut().zip(plan.spectrum(response.iter().copied())).for_each(|(a, b)| *a *= b);
    plan.signal(product)
}

/// The smallest even number of samples that is at least `least` and has no prime factors but 2, 3 and 5: a size for
/// which Fourier transforms are fast.
pub fn smooth_size(least: usize) -> usize {
    let ceiling = least.max(2).next_power_of_two();
    let mut best = ceiling;
    let mut fives = 1;
    while fives < ceiling {
        let mut odd = fives;
        while odd < ceiling {
            let size = odd * least.div_ceil(odd).next_power_of_two().max(2);
            best = best.min(size);
            odd *= 3;
        }
        fives *= 5;
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_sum_that_defines_it() {
        for (a, b) in [(1, 1), (1, 9), (7, 5), (64, 33), (100, 101)] {
            let x: Vec<f64> = (0..a).map(|i| (f64::from(i) * 1.7).sin()).collect();
            let h: Vec<f64> = (0..b).map(|i| (f64::from(i) * 0.3).cos() + 0.2).collect();
            let y = convolve(&x, &h);
            assert_eq!(y.len(), x.len() + h.len() - 1);
            for (i, value) in y.iter().enumerate() {
                let sum: f64 =
                    (0..=i).filter(|&j| j < x.len() && i - j < h.len()).map(|j| x[j] * h[i - j]).sum();
                assert!((value - sum).abs() < 1e-11, "{a} x {b} at {i}");
            }
        }
        assert!(convolve(&[], &[1.0]).is_empty());
    }

    #[test]
    fn sizes_are_the_next_smooth_even_ones() {
        let smooth = |mut n: usize| {
            for p in [2, 3, 5] {
                while n.is_multiple_of(p) {
                    n /= p;
                }
            }
            n == 1
        };
        for least in 1..3000 {
            let next = (least.max(2)..).find(|&n: &usize| n.is_multiple_of(2) && smooth(n)).unwrap();
            assert_eq!(smooth_size(least), next, "{least}");
        }
    }
}
