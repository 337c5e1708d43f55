//! The force of a tap, computed from the sensors' signals and modelled responses, and the assumptions about
//! taps.

use crate::CalibrateError;
use crate::signals::Band;
use unripple_linalg::{Cholesky, Mat, non_negative, product, squared_norm};

/// Regularisation of the force: added to the normal matrix, relative to the mean of its diagonal. Less would follow noise at frequencies
/// that the sensors hardly receive; more would make the force weaker than it is, by about this share.
const RIDGE: f64 = 1e-4;

/// Assumptions about the forces of taps, and about the time for which the model is accurate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TapOptions {
    /// Longest duration of a tap, in s, without bounces.
    pub length: f64,
    /// Longest time from a tap to its last bounce, in s.
    pub bounces: f64,
    /// Time after the last possible force, in s, for which signals are still compared with the model.
    pub early: f64,
    /// Whether a tap is known to push and never to pull, so that its force has one sign.
    pub pushes: bool,
    /// Regularisation of the deconvolution: power added to that of the taps' spectra, relative to their strongest line in the band.
    pub floor: f64,
}

impl Default for TapOptions {
    /// For a model that was fitted to the surface: bounces within 13 ms.
    fn default() -> Self {
        Self { length: 2.5e-3, bounces: 13e-3, early: 6e-3, pushes: true, floor: 1e-3 }
    }
}

impl TapOptions {
    /// Options for a model that was not fitted to the surface. Without bounces, only the first 11 ms of the
    /// signals are compared with it, in which a small error of tension hardly moves reflections; a force
    /// that may pull compensates part of its errors.
    pub fn for_unfitted() -> Self {
        Self { bounces: 0.0, pushes: false, ..Self::default() }
    }

    /// Duration, in s, of the part of the signals in which there may be a force: twice the length of a tap,
    /// since its start is uncertain, plus the time until the last bounce.
    pub fn span(&self) -> f64 {
        2.0 * self.length + self.bounces
    }
}

/// The force of a tap, and how well it explains the sensors' signals.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Force {
    /// Samples of the force, in N, from the first sample of the signals on.
    pub samples: Vec<f64>,
    /// Share of the signals' power that the force leaves unexplained, within the time compared with the
    /// model.
    pub unexplained: f64,
}

impl Force {
    /// Finds the force that best explains the sensors' signals (`heard`, `[sensor][sample]`) with the
    /// modelled responses (`model`, also `[sensor][sample]`) in the least-squares sense, linear between
    /// knots. All signals are limited to the band, so that responses begin before their impulse: the model's
    /// have `lead` samples before it.
    ///
    /// A tap pushes and never pulls, so that its force has one sign. With a good model, this keeps noise
    /// from being taken for a bounce. With a poor one, a force that may pull compensates part of the model's
    /// errors.
    pub fn find(
        heard: &[Vec<f64>],
        (model, lead): (&[Vec<f64>], usize),
        (rate, band): (f64, Band),
        options: &TapOptions,
    ) -> Result<Self, CalibrateError> {
        // Knots as close as the top of the band requires, and signals sampled no more closely: they contain
        // nothing above it.
        let step = (rate / (3.0 * band.high[1].min(rate / 3.0))).round().max(1.0) as usize;
        let samples = |seconds: f64| (seconds * rate) as usize;
        let (span, all) = (samples(options.span()), samples(options.span() + options.early));
        // After the end of a recording nothing is known.
        let all = all.min(heard.iter().map(Vec::len).min().unwrap_or(0));
        let (knots, rows, ahead) = (span / step + 1, all.div_ceil(step), lead / step);
        // A triangular force at each knot; triangles add up to straight lines between knots.
        let hat: Vec<f64> =
            (0..2 * step - 1).map(|i| 1.0 - (i as f64 + 1.0 - step as f64).abs() / step as f64).collect();
        let mut design = Mat::<f64>::zeros(heard.len() * rows, knots);
        let mut signal = Mat::<f64>::zeros(heard.len() * rows, 1);
        for (a, (heard, model)) in heard.iter().zip(model).enumerate() {
            let at = |i: usize| {
                let reach = hat.iter().enumerate().filter(|(j, _)| *j <= i);
                reach.map(|(j, f)| f * model.get(i - j).copied().unwrap_or(0.0)).sum::<f64>() / rate
            };
            let moved: Vec<f64> = (0..rows + ahead).map(|n| at(lead - ahead * step + n * step)).collect();
            for n in 0..rows {
                signal[(a * rows + n, 0)] = heard[n * step];
                (0..knots.min(n + ahead + 1)).for_each(|k| design[(a * rows + n, k)] = moved[n + ahead - k]);
            }
        }
        let mut normal = product(design.transpose(), design.as_ref());
        let ridge = RIDGE * (0..knots).map(|k| normal[(k, k)]).sum::<f64>() / knots as f64;
        (0..knots).for_each(|k| normal[(k, k)] += ridge);
        let right = product(design.transpose(), signal.as_ref());
        let force = solved(&normal, right, options.pushes).ok_or_else(|| CalibrateError::Recording {
            what: "force of a tap".into(),
            expected: "a model that moves at the place".into(),
            found: "one at rest".into(),
        })?;
        let left = &signal - product(design.as_ref(), force.as_ref());
        let unexplained = squared_norm(left.as_ref()) / squared_norm(signal.as_ref()).max(f64::MIN_POSITIVE);
        let mut samples = vec![0.0; span + 2 * step];
        for k in 0..knots {
            hat.iter().enumerate().for_each(|(j, f)| samples[k * step + j] += f * force[(k, 0)]);
        }
        Ok(Self { samples, unexplained })
    }
}

/// Solution of the normal equations, or with `one_sign` the best whose elements all have one sign; `None` for a matrix that is not positive
/// definite.
fn solved(normal: &Mat<f64>, right: Mat<f64>, one_sign: bool) -> Option<Mat<f64>> {
    let count = right.nrows();
    let factor = Cholesky::new(normal.as_ref())?;
    if !one_sign {
        let mut free = right;
        factor.solve(free.as_mut());
        return Some(free);
    }
    let of_sign = |sign: f64| {
        let slope: Vec<f64> = (0..count).map(|k| sign * right[(k, 0)]).collect();
        let found = non_negative(|i, j| normal[(i, j)], &slope, vec![0.0; count]);
        // At the optimum, half of this is what the objective has fallen by.
        let gain: f64 = found.iter().zip(&slope).map(|(x, b)| x * b).sum();
        (gain, Mat::from_fn(count, 1, |k, _| sign * found[k]))
    };
    let (push, pull) = (of_sign(1.0), of_sign(-1.0));
    Some(if push.0 >= pull.0 { push.1 } else { pull.1 })
}
