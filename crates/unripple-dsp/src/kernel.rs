//! Weights of polyphase interpolation between samples: a Kaiser-windowed sinc.

use crate::special::{kaiser, sinc};
use std::f64::consts::PI;
use unripple_core::Pole;
use unripple_linalg::Mat;

/// An interpolation kernel from a reduced sample rate to a rate `step` times as high: `taps` weights for
/// each of `step` phases.
///
/// A Kaiser-windowed sinc (Kaiser, in *System Analysis by Digital Computer*, 1966, chapter 7), for signals that stay below
/// half the reduced rate by a margin.
#[derive(Debug)]
pub(crate) struct Kernel {
    /// Number of full-rate samples from one reduced sample to the next.
    pub(crate) step: usize,
    /// Weights, taps x phases.
    pub(crate) weights: Mat<f64>,
}

impl Kernel {
    /// A kernel of `2 · half` taps for each of `step` phases, with a Kaiser window of shape `beta`.
    pub(crate) fn new(step: usize, half: usize, beta: f64) -> Self {
        let weights = Mat::from_fn(2 * half, step, |tap, phase| {
            let t = phase as f64 / step as f64 - (tap as f64 - half as f64 + 1.0);
            sinc(t) * kaiser(t / half as f64, beta)
        });
        Self { step, weights }
    }

    /// Number of taps, the same in each phase.
    pub(crate) fn taps(&self) -> usize {
        self.weights.nrows()
    }

    /// Number of samples at the reduced rate that the kernel needs before time 0 for the first output
    /// sample.
    pub(crate) fn lead(&self) -> usize {
        (self.taps() / 2).saturating_sub(1)
    }

    /// Half the number of taps, and the window's β, with which signals of frequencies up to `fill` times
    /// half the reduced rate are interpolated within the relative error `accuracy`, by Kaiser's design
    /// formulas. The accuracy is divided by 2.5 since several images fold onto the signal.
    pub(crate) fn size(fill: f64, accuracy: f64) -> (usize, f64) {
        let attenuation = (-20.0 * (accuracy / 2.5).log10()).max(21.0);
        let beta = if attenuation > 50.0 {
            0.1102 * (attenuation - 8.7)
        } else {
            0.5842 * (attenuation - 21.0).powf(0.4) + 0.07886 * (attenuation - 21.0)
        };
        let taps = 1.0 + (attenuation - 8.0) / (2.285 * 2.0 * PI * (1.0 - fill));
        ((taps / 2.0).ceil().max(1.0) as usize, beta)
    }

    /// Largest error of interpolating e^{zt}, relative to |e^{zt}| at the same time, where z is the pole's complex frequency.
    pub(crate) fn error(&self, pole: Pole, rate: f64) -> f64 {
        let square = (pole.omega - pole.sigma) * (pole.omega + pole.sigma);
        if square < 0.0 {
            return f64::INFINITY;
        }
        let (angle, decay) = (square.sqrt() * self.step as f64 / rate, pole.sigma * self.step as f64 / rate);
        let turn = ((-decay).exp() * angle.cos(), (-decay).exp() * angle.sin());
        (0..self.step)
            .map(|phase| {
                let first = -(phase as f64 / self.step as f64 + self.lead() as f64);
                let size = (-decay * first).exp();
                let (mut x, mut y) = (size * (angle * first).cos(), size * (angle * first).sin());
                let (mut re, mut im) = (-1.0, 0.0);
                for weight in self.weights.col(phase).iter() {
                    re += weight * x;
                    im += weight * y;
                    (x, y) = (x * turn.0 - y * turn.1, x * turn.1 + y * turn.0);
                }
                re.hypot(im)
            })
            .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reaches_its_accuracy_over_its_band_with_a_tap_or_two_to_spare() {
        for accuracy in [1e-3, 1e-6, 1e-9, 1e-12] {
            for fill in [0.2, 0.5, 0.8] {
                let (half, beta) = Kernel::size(fill, accuracy);
                let worst = |half: usize| {
                    let kernel = Kernel::new(5, half, beta);
                    (0..=40)
                        .map(|part| Pole::new(fill * f64::from(part) / 40.0 * PI * 1e3 / 5.0, 0.0))
                        .map(|pole| kernel.error(pole, 1e3))
                        .fold(0.0, f64::max)
                };
                let best = (half..half + 3).map(worst).fold(f64::INFINITY, f64::min);
                assert!(best <= accuracy, "{accuracy} {fill}: {best}");
            }
        }
    }

    #[test]
    fn says_its_error() {
        let kernel = Kernel::new(3, 6, 5.0);
        let pole = Pole::new(700.0, 20.0);
        let exact = |t: f64| (-pole.sigma * t).exp() * ((pole.omega * pole.omega - 400.0).sqrt() * t).cos();
        for phase in 0..3 {
            let found: f64 =
                (0..12).map(|tap| kernel.weights[(tap, phase)] * exact((tap as f64 - 5.0) * 3.0 / 1e3)).sum();
            let error = (found - exact(phase as f64 / 1e3)).abs();
            assert!(error <= kernel.error(pole, 1e3), "{phase}: {error}");
        }
    }
}
