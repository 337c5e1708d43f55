//! Fitting of a model's free quantities to measured frequencies: Gauss-Newton steps with damping, the assignment made anew at each.

use super::matching::{Matching, matched};
use super::model::{Computed, Model};
use crate::CalibrateError;
use unripple_linalg::{Cholesky, Mat};

/// Most steps of a fit: from a good start a handful is enough.
const STEPS: usize = 30;

/// Most trials for the damping of one step; the last one is damped a millionfold.
const TRIALS: usize = 7;

/// Longest step of a logarithm: a factor of 1.6, beyond which modes are different ones.
const LONGEST: f64 = 0.5;

/// Largest logarithm of a factor: a thousandfold of what the file says is no correction of it.
const FARTHEST: f64 = 7.0;

/// A step shorter than this, in deviations of a frequency, ends the fit, and so does a smaller relative gain: both are far below what is
/// told.
const SHORT: f64 = 3e-3;
const GAIN: f64 = 1e-4;

/// Measured frequencies, ready for a fit.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    /// Logarithms of the measured frequencies in Hz, ascending.
    pub logs: Vec<f64>,
    /// Standard deviation of each of them.
    pub deviation: f64,
}

impl Problem {
    /// Frequency in Hz up to which modes are needed: an assignment beyond would cost more than none.
    pub fn top(&self) -> f64 {
        self.logs.last().map_or(1.0, |log| (log + 5.0 * self.deviation).exp())
    }
}

/// A surface that explains measured frequencies, at a minimum of the cost.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    /// Logarithms of the factors on the free quantities.
    pub logs: Vec<f64>,
    /// The modes of the surface.
    pub computed: Computed,
    /// Which mode each measured frequency is.
    pub matching: Matching,
    /// Residual of each pair, the logarithm of measured over computed frequency.
    pub residuals: Vec<f64>,
    /// Derivatives of the logarithm of each pair's computed frequency, pairs x quantities.
    pub jacobian: Vec<Vec<f64>>,
}

/// A trial of the fit.
struct Trial {
    logs: Vec<f64>,
    computed: Computed,
    matching: Matching,
}

fn trial(model: &Model<'_>, problem: &Problem, logs: Vec<f64>) -> Result<Trial, CalibrateError> {
    let computed = model.modes(&logs, problem.top())?;
    let matching = matched(&problem.logs, &computed.logs(), problem.deviation);
    Ok(Trial { logs, computed, matching })
}

/// Fits from the start `from`, the logarithms of factors on the free quantities.
pub(super) fn solved(model: &Model<'_>, problem: &Problem, from: &[f64]) -> Result<Solved, CalibrateError> {
    let mut here = trial(model, problem, from.to_vec())?;
    let mut damping = 1e-3;
    for _ in 0..STEPS {
        let (residuals, jacobian) = linearised(model, problem, &here)?;
        if jacobian.is_empty() {
            break;
        }
        let (square, slope) = normal(&residuals, &jacobian, problem.deviation);
        let mut better = None;
        for _ in 0..TRIALS {
            let step = damped(&square, &slope, damping);
            let logs: Vec<f64> = here.logs.iter().zip(&step).map(|(log, by)| log + by).collect();
            let near = logs.iter().all(|log| log.abs() <= FARTHEST);
            // Where a surface of a trial cannot be computed, the step was too long.
            let tried = if near { trial(model, problem, logs).ok() } else { None };
            better =
                tried.filter(|tried| tried.matching.cost < here.matching.cost).map(|tried| (tried, step));
            if better.is_some() {
                break;
            }
            damping *= 10.0;
        }
        let Some((next, step)) = better else { break };
        let gain = here.matching.cost - next.matching.cost;
        here = next;
        damping = (0.1 * damping).max(1e-9);
        if step.iter().all(|by| by.abs() < SHORT * problem.deviation)
            || gain < GAIN * (1.0 + here.matching.cost)
        {
            break;
        }
    }
    let (residuals, jacobian) = linearised(model, problem, &here)?;
    let Trial { logs, computed, matching } = here;
    Ok(Solved { logs, computed, matching, residuals, jacobian })
}

/// Residuals and derivatives of the pairs of a trial.
fn linearised(
    model: &Model<'_>,
    problem: &Problem,
    here: &Trial,
) -> Result<(Vec<f64>, Vec<Vec<f64>>), CalibrateError> {
    let computed = here.computed.logs();
    let pairs = &here.matching.pairs;
    let residuals = pairs.iter().map(|(i, j)| problem.logs[*i] - computed[*j]).collect();
    let all = model.sensitivities(&here.logs, &here.computed)?;
    Ok((residuals, pairs.iter().map(|(_, j)| all[*j].clone()).collect()))
}

/// The normal equations: the information matrix JᵀJ/σ², quantities x quantities, and Jᵀr/σ².
pub(super) fn normal(residuals: &[f64], jacobian: &[Vec<f64>], deviation: f64) -> (Mat<f64>, Vec<f64>) {
    let count = jacobian.first().map_or(0, Vec::len);
    let weight = 1.0 / (deviation * deviation);
    let sum = |of: &dyn Fn(usize) -> f64| weight * (0..residuals.len()).map(of).sum::<f64>();
    let square = Mat::from_fn(count, count, |a, b| sum(&|i| jacobian[i][a] * jacobian[i][b]));
    let slope = (0..count).map(|a| sum(&|i| jacobian[i][a] * residuals[i])).collect();
    (square, slope)
}

/// The step that the normal equations ask for, each of its components at most [`LONGEST`]. Damping keeps to where they are told anything.
fn damped(square: &Mat<f64>, slope: &[f64], damping: f64) -> Vec<f64> {
    let count = slope.len();
    let largest = (0..count).map(|a| square[(a, a)]).fold(0.0, f64::max);
    let lifted = Mat::from_fn(count, count, |a, b| {
        let own = if a == b { damping * square[(a, a)].max(1e-6 * largest) } else { 0.0 };
        square[(a, b)] + own
    });
    let mut step = Mat::from_fn(count, 1, |a, _| slope[a]);
    match Cholesky::new(lifted.as_ref()) {
        Some(factor) => factor.solve(step.as_mut()),
        None => return vec![0.0; count],
    }
    let longest = (0..count).map(|a| step[(a, 0)].abs()).fold(0.0, f64::max);
    let short = if longest > LONGEST { LONGEST / longest } else { 1.0 };
    (0..count).map(|a| short * step[(a, 0)]).collect()
}
