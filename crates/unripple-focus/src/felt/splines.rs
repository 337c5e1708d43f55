//! Drives as cubic B-splines: smooth signals of few coefficients.

use std::ops::Range;
use unripple_linalg::Mat;

/// Cubic B-splines with equally spaced knots, the first knot at sample 0, truncated to the samples of the
/// drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Splines {
    /// Distance between knots, in samples.
    pub step: usize,
    /// Number of samples of the drive.
    pub samples: usize,
}

impl Splines {
    /// Number of splines, one per knot; the last knot is at or after the last sample.
    pub fn count(self) -> usize {
        (self.samples.max(1) - 1).div_ceil(self.step) + 1
    }

    /// The samples at which a spline is not zero.
    fn support(self, knot: usize) -> Range<usize> {
        let centre = knot * self.step;
        let reach = 2 * self.step - 1;
        centre.saturating_sub(reach)..(centre + reach + 1).min(self.samples)
    }

    /// The value of one spline at a sample: 2/3 at its knot, 0 from two knots away.
    fn value(self, knot: usize, sample: usize) -> f64 {
        let x = (sample as f64 - (knot * self.step) as f64).abs() / self.step as f64;
        match x {
            x if x < 1.0 => 2.0 / 3.0 - x * x + x * x * x / 2.0,
            x if x < 2.0 => (2.0 - x).powi(3) / 6.0,
            _ => 0.0,
        }
    }

    /// The values of one spline at all samples of the drive.
    pub fn signal(self, knot: usize) -> Vec<f64> {
        let mut signal = vec![0.0; self.samples];
        self.support(knot).for_each(|i| signal[i] = self.value(knot, i));
        signal
    }

    /// Signal that is the sum of all splines, each times its coefficient: one number per sample of the
    /// drive.
    pub fn sum(self, coefficients: &[f64]) -> Vec<f64> {
        let mut signal = vec![0.0; self.samples];
        for (knot, c) in coefficients.iter().enumerate() {
            self.support(knot).for_each(|i| signal[i] += c * self.value(knot, i));
        }
        signal
    }

    /// Sum over samples of the product of each two splines, splines x splines.
    pub fn products(self) -> Mat<f64> {
        let count = self.count();
        let mut products = Mat::zeros(count, count);
        for k in 0..count {
            for l in k..(k + 4).min(count) {
                let both = self.support(k).filter(|i| self.support(l).contains(i));
                let product = both.map(|i| self.value(k, i) * self.value(l, i)).sum();
                products[(k, l)] = product;
                products[(l, k)] = product;
            }
        }
        products
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn their_sum_is_one_away_from_the_ends() {
        for (samples, step) in [(97, 8), (100, 7), (50, 1)] {
            let splines = Splines { step, samples };
            let sum = splines.sum(&vec![1.0; splines.count()]);
            let inner = &sum[step..samples - step];
            assert!(inner.iter().all(|x| (x - 1.0).abs() < 1e-12), "{samples} {step}");
        }
    }

    #[test]
    fn products_are_energies() {
        let splines = Splines { step: 6, samples: 41 };
        let c: Vec<f64> = (0..splines.count()).map(|k| (1.7 * k as f64).sin()).collect();
        let energy: f64 = splines.sum(&c).iter().map(|d| d * d).sum();
        let products = splines.products();
        let form: f64 = (0..c.len())
            .flat_map(|k| (0..c.len()).map(move |l| (k, l)))
            .map(|(k, l)| c[k] * products[(k, l)] * c[l])
            .sum();
        assert!((form / energy - 1.0).abs() < 1e-12);
        assert_eq!(splines.signal(2).iter().filter(|x| **x != 0.0).count(), 23);
    }
}
