//! Exponentials refined by least squares, with the deviations that the noise leaves them.

use unripple_linalg::{Lu, Mat, adjoint_times, c64};

/// Most Gauss-Newton steps; from ESPRIT three are enough.
const STEPS: usize = 8;

/// A relative change of the sum of squares that ends the refinement.
const ENOUGH: f64 = 1e-7;

/// Least ratio of an amplitude to its deviation: white noise alone reaches it in one of 10^14 trials. The sound of a room, which decays as
/// modes do, reaches it often.
pub(super) const CLEAR: f64 = 8.0;

/// A decaying exponential: amplitude · exp(log · n) at sample n.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Exponential {
    /// Logarithm of the factor from sample to sample.
    pub log: c64,
    /// Amplitude at the first sample.
    pub amplitude: c64,
    /// Standard deviation of the real part, and of the imaginary part, of the logarithm.
    pub spread: f64,
    /// Standard deviation of either part of the amplitude.
    pub amplitude_spread: f64,
}

impl Exponential {
    /// Amplitude over its standard deviation.
    pub fn clarity(&self) -> f64 {
        self.amplitude.norm() / self.amplitude_spread.max(f64::MIN_POSITIVE)
    }
}

/// Exponentials of samples, with their least-squares amplitudes.
struct Fitted {
    logs: Vec<c64>,
    /// The exponentials, samples x exponentials.
    waves: Mat<c64>,
    amplitudes: Vec<c64>,
    /// What they leave of the samples, as a column.
    rest: Mat<c64>,
    squares: f64,
}

impl Fitted {
    fn of(samples: &[c64], logs: Vec<c64>) -> Option<Self> {
        let waves = Mat::from_fn(samples.len(), logs.len(), |n, k| (logs[k] * n as f64).exp());
        let column = Mat::from_fn(samples.len(), 1, |n, _| samples[n]);
        let amplitudes = Normal::of(&waves)?.solution(&waves, &column)?;
        let left =
            |n: usize| samples[n] - (0..logs.len()).map(|k| waves[(n, k)] * amplitudes[k]).sum::<c64>();
        let rest = Mat::from_fn(samples.len(), 1, |n, _| left(n));
        let squares = (0..samples.len()).map(|n| rest[(n, 0)].norm_sqr()).sum();
        Some(Self { logs, waves, amplitudes, rest, squares })
    }

    /// Derivatives of the samples by amplitudes and logarithms, samples x twice the exponentials. The sum is an analytic function of all,
    /// so that complex derivatives are enough.
    fn slopes(&self) -> Mat<c64> {
        let count = self.logs.len();
        Mat::from_fn(self.waves.nrows(), 2 * count, |n, k| match k.checked_sub(count) {
            None => self.waves[(n, k)],
            Some(k) => self.waves[(n, k)] * self.amplitudes[k] * n as f64,
        })
    }
}

/// The normal equations of a complex least-squares problem, with columns scaled to unit length.
struct Normal {
    scale: Vec<f64>,
    factors: Lu<c64>,
}

impl Normal {
    /// Those of the columns of a matrix; `None` if one of them is zero or not finite.
    fn of(columns: &Mat<c64>) -> Option<Self> {
        let length = |k: usize| (0..columns.nrows()).map(|n| columns[(n, k)].norm_sqr()).sum::<f64>().sqrt();
        let scale: Vec<f64> = (0..columns.ncols()).map(|k| 1.0 / length(k)).collect();
        if scale.is_empty() || scale.iter().any(|scale| !scale.is_finite() || *scale == 0.0) {
            return None;
        }
        let square = adjoint_times(columns.as_ref(), columns.as_ref());
        let count = scale.len();
        let scaled = Mat::from_fn(count, count, |i, j| square[(i, j)] * (scale[i] * scale[j]));
        Some(Self { scale, factors: Lu::new(scaled.as_ref()) })
    }

    /// The solution for a right-hand side, samples x 1; `None` if it is not finite.
    fn solution(&self, columns: &Mat<c64>, right: &Mat<c64>) -> Option<Vec<c64>> {
        let product = adjoint_times(columns.as_ref(), right.as_ref());
        let mut scaled = Mat::from_fn(self.scale.len(), 1, |i, _| product[(i, 0)] * self.scale[i]);
        self.factors.solve(scaled.as_mut());
        let found: Vec<c64> = (0..self.scale.len()).map(|i| scaled[(i, 0)] * self.scale[i]).collect();
        found.iter().all(|x| x.re.is_finite() && x.im.is_finite()).then_some(found)
    }

    /// The diagonal of the inverse.
    fn inverse_diagonal(&self) -> Vec<f64> {
        let inverse = self.factors.inverse();
        self.scale.iter().enumerate().map(|(i, scale)| inverse[(i, i)].re * scale * scale).collect()
    }
}

/// Refines exponentials of samples from the logarithms of their factors, and leaves out one by one those that are not [clear](CLEAR) of the
/// noise: two exponentials may share one mode, so that both are unclear though the mode is strong. The last one is kept, clear or not.
/// `None` if the equations are singular, or if there are too many exponentials for the samples.
pub(super) fn refined(samples: &[c64], logs: Vec<c64>) -> Option<Vec<Exponential>> {
    let mut found = refined_together(samples, logs)?;
    while found.len() > 1 {
        let clarities = found.iter().map(Exponential::clarity).enumerate();
        let (weakest, clarity) = clarities.min_by(|a, b| a.1.total_cmp(&b.1))?;
        if clarity >= CLEAR {
            break;
        }
        found.remove(weakest);
        let Some(next) = refined_together(samples, found.iter().map(|one| one.log).collect()) else { break };
        found = next;
    }
    Some(found)
}

/// Refines all exponentials of samples together.
fn refined_together(samples: &[c64], logs: Vec<c64>) -> Option<Vec<Exponential>> {
    let count = logs.len();
    if count == 0 || samples.len() < 3 * count {
        return None;
    }
    let mut here = Fitted::of(samples, logs)?;
    for _ in 0..STEPS {
        let slopes = here.slopes();
        let Some(step) = Normal::of(&slopes).and_then(|normal| normal.solution(&slopes, &here.rest)) else {
            break;
        };
        let logs = here.logs.iter().zip(&step[count..]).map(|(log, by)| log + by).collect();
        let Some(next) = Fitted::of(samples, logs) else { break };
        if next.squares >= here.squares {
            break;
        }
        let gain = here.squares - next.squares;
        here = next;
        if gain < ENOUGH * here.squares {
            break;
        }
    }
    let spare = samples.len() - 2 * count;
    let noise = here.squares / spare as f64;
    let inverse = Normal::of(&here.slopes())?.inverse_diagonal();
    // Half of the power of the noise is in each part of a complex number. A variance that is not above 0 is rounding: the equations are
    // singular.
    let spread = |i: usize| if inverse[i] > 0.0 { (0.5 * noise * inverse[i]).sqrt() } else { f64::INFINITY };
    let one = |k: usize| Exponential {
        log: here.logs[k],
        amplitude: here.amplitudes[k],
        spread: spread(count + k),
        amplitude_spread: spread(k),
    };
    Some((0..count).map(one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Random;

    #[test]
    fn two_exponentials_of_one_mode_become_one() {
        let mut random = Random::seeded(5);
        let truth = c64::new(-0.02, 0.4);
        let mut noise = || c64::new(random.normal(), random.normal()) * 0.02;
        let samples: Vec<c64> = (0..150).map(|n: i32| (truth * f64::from(n)).exp() + noise()).collect();
        let apart = c64::new(2e-3, 4e-3);
        let found = refined(&samples, vec![truth + apart, truth - apart, c64::new(-0.03, -1.0)]).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].log - truth).norm() < 2e-3 && found[0].clarity() > 5.0 * CLEAR, "{found:?}");
    }

    #[test]
    fn modes_side_by_side_stay_two() {
        let mut random = Random::seeded(6);
        let truth = [c64::new(-0.02, 0.4), c64::new(-0.02, 0.5)];
        let mut noise = || c64::new(random.normal(), random.normal()) * 0.01;
        let sample = |n: i32| truth.iter().map(|log| (*log * f64::from(n)).exp()).sum::<c64>() + noise();
        let samples: Vec<c64> = (0..150).map(sample).collect();
        let found = refined(&samples, truth.to_vec()).unwrap();
        assert_eq!(found.len(), 2, "{found:?}");
    }
}
