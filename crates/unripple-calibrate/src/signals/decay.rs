//! Decay time of a response: an exponential and a noise floor fitted to its energy.

use super::positive;
use unripple_dsp::{DspError, mean_square};

/// Exponential decay of a response: its power modelled as `power · e^{-2t/time} + noise` from its strongest moment on.
///
/// Fitted to the power in short blocks, whose scatter is in proportion to their mean, by gamma quasi-likelihood; so noise is
/// neither subtracted nor cut off beforehand. Source of the model: M. Karjalainen et al., J. Audio Eng. Soc. 50 (2002),
/// eq. 5; of the fit: P. McCullagh, J. A. Nelder, "Generalized Linear Models" (1989), chapter 8.
///
/// ```
/// use unripple_calibrate::signals::Decay;
///
/// let ringing: Vec<f64> = (0..24_000).map(|i| (f64::from(i) * 0.1).sin() * (-f64::from(i) / 3360.0).exp()).collect();
/// let decay = Decay::of(&ringing, 48e3)?.expect("it dies away");
/// assert!((decay.time - 0.07).abs() < 1e-3);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decay {
    /// Seconds in which the amplitude falls to 1/e.
    pub time: f64,
    /// Standard error of `time` in seconds, from the scatter of the blocks about the model.
    pub error: f64,
    /// Mean square of the response at its strongest moment, without noise.
    pub power: f64,
    /// Mean square of the noise in which the decay ends; for a response without noise, the mean square of the
    /// response at its end.
    pub noise: f64,
}

/// Number of blocks into which a response is divided: twice as many follow the decay more finely, but each
/// scatters more.
const BLOCKS: usize = 200;

/// Fewest blocks, from the strongest on, to which a decay is fitted. Three unknowns need some more than
/// three, since blocks scatter.
const FEWEST: usize = 8;

/// Smallest ratio of the strongest block's power to the noise: 5 dB. With half of it, noise alone may be
/// taken for a decay.
const LEAST_RATIO: f64 = 3.0;

/// Largest number of steps of the descent, which settles in far fewer.
const STEPS: usize = 200;

impl Decay {
    /// The decay of a response; `None` if it does not rise above its noise (by 5 dB), grows, or ends too soon after its strongest
    /// moment.
    ///
    /// # Errors
    /// [`DspError::Range`] if `rate` is not positive.
    pub fn of(response: &[f64], rate: f64) -> Result<Option<Self>, DspError> {
        positive("samples per second", rate)?;
        let length = response.len().div_ceil(BLOCKS).max(1);
        let powers: Vec<f64> = response.chunks_exact(length).map(mean_square).collect();
        let strongest = (0..powers.len()).max_by(|&a, &b| powers[a].total_cmp(&powers[b])).unwrap_or(0);
        let tail = &powers[strongest.min(powers.len())..];
        let most = tail.first().copied().unwrap_or(0.0);
        if tail.len() < FEWEST || most <= 0.0 || !tail.iter().all(|x| x.is_finite()) {
            return Ok(None);
        }
        let relative: Vec<f64> = tail.iter().map(|x| (x / most).max(LEAST)).collect();
        let Some((model, error)) = fitted(&relative) else { return Ok(None) };
        let [power, fall, noise] = [model[0].exp(), model[1], model[2].exp()];
        if fall <= 0.0 || power < LEAST_RATIO * noise {
            return Ok(None);
        }
        let block = length as f64 / rate;
        let time = 2.0 * block / fall;
        Ok(Some(Self { time, error: time * error / fall, power: power * most, noise: noise * most }))
    }
}

/// Smallest power of a block, relative to the largest: lower ones are raised to it.
const LEAST: f64 = 1e-24;

/// Log power, fall per block and log noise that fit best, and the standard error of the fall.
fn fitted(powers: &[f64]) -> Option<([f64; 3], f64)> {
    // Two starting models, since a decay that is cut off looks like one that ends in noise: the better result counts.
    let best = [settled(powers), unsettled(powers)].into_iter().flatten().map(|start| descend(powers, start));
    let (model, _) = best.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (_, mut curve) = gradient(powers, &model);
    (0..3).for_each(|i| curve[i][i] += 1e-12);
    let scatter = residuals(powers, &model).map(|r| r * r).sum::<f64>() / (powers.len() - 3) as f64;
    let variance = solve(curve, [0.0, 1.0, 0.0])?[1] * scatter;
    Some((model, variance.max(0.0).sqrt()))
}

/// Starting model from moments, if the last tenth is noise.
fn settled(powers: &[f64]) -> Option<[f64; 3]> {
    let last = powers.len() - powers.len() / 10 - 1;
    let noise = powers[last..].iter().sum::<f64>() / (powers.len() - last) as f64;
    let above = powers.iter().take_while(|x| **x > 2.0 * noise);
    let (sum, moment) = above.enumerate().fold((0.0, 0.0), |(sum, moment), (k, x)| {
        (sum + (x - noise), moment + (x - noise) * (k as f64 + 0.5))
    });
    (sum > 0.0).then(|| [powers[0].ln(), sum / moment, noise.ln()])
}

/// Starting model from the first and the last third, if there is hardly any noise.
fn unsettled(powers: &[f64]) -> Option<[f64; 3]> {
    let third = powers.len() / 3;
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let [first, last] = [mean(&powers[..third]), mean(&powers[powers.len() - third..])];
    let fall = (first / last).ln() / (powers.len() - third) as f64;
    (fall > 0.0).then(|| [first.ln() + fall * third as f64 / 2.0, fall, last.ln() - 7.0])
}

/// The model that fits best, from a starting one, and its cost: Fisher scoring, damped as by Levenberg-Marquardt.
fn descend(powers: &[f64], mut model: [f64; 3]) -> ([f64; 3], f64) {
    let (mut cost, mut damping) = (cost(powers, &model), 1e-3);
    for _ in 0..STEPS {
        let (slope, curve) = gradient(powers, &model);
        let mut damped = curve;
        (0..3).for_each(|i| damped[i][i] = curve[i][i] * (1.0 + damping) + 1e-12);
        let Some(step) = solve(damped, slope) else { break };
        let next = [model[0] - step[0], model[1] - step[1], (model[2] - step[2]).max(LEAST.ln())];
        let new = self::cost(powers, &next);
        if new <= cost {
            let gain = cost - new;
            (model, cost, damping) = (next, new, damping / 3.0);
            if gain < 1e-12 * powers.len() as f64 {
                break;
            }
        } else {
            damping *= 4.0;
        }
    }
    (model, cost)
}

/// Modelled power of the decay alone, and with noise, at a block.
fn at(model: &[f64; 3], block: usize) -> [f64; 2] {
    let decaying = (model[0] - model[1] * block as f64).exp();
    [decaying, decaying + model[2].exp()]
}

fn cost(powers: &[f64], model: &[f64; 3]) -> f64 {
    let terms = powers.iter().enumerate().map(|(k, x)| {
        let [_, all] = at(model, k);
        all.ln() + x / all
    });
    let sum: f64 = terms.sum();
    if sum.is_finite() { sum } else { f64::INFINITY }
}

fn residuals<'a>(powers: &'a [f64], model: &'a [f64; 3]) -> impl Iterator<Item = f64> + 'a {
    powers.iter().enumerate().map(|(k, x)| x / at(model, k)[1] - 1.0)
}

/// Gradient of the cost, and expectation of its Hessian.
fn gradient(powers: &[f64], model: &[f64; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let (mut slope, mut curve) = ([0.0; 3], [[0.0; 3]; 3]);
    for (k, residual) in residuals(powers, model).enumerate() {
        let [decaying, all] = at(model, k);
        let relative = [decaying / all, -(k as f64) * decaying / all, 1.0 - decaying / all];
        for i in 0..3 {
            slope[i] -= residual * relative[i];
            (0..3).for_each(|j| curve[i][j] += relative[i] * relative[j]);
        }
    }
    (slope, curve)
}

/// Three equations by Cramer's rule; `None` if they are singular.
fn solve(a: [[f64; 3]; 3], b: [f64; 3]) -> Option<[f64; 3]> {
    let det = |m: &[[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let whole = det(&a);
    let with = |column: usize| {
        let mut replaced = a;
        replaced.iter_mut().zip(b).for_each(|(row, value)| row[column] = value);
        det(&replaced) / whole
    };
    let solution = [with(0), with(1), with(2)];
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}
