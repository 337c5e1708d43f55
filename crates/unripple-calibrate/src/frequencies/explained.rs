//! A fitted surface: its values with their intervals, which mode each frequency is, and what is left over.

use super::model::Model;
use super::solve::{Problem, Solved, normal};
use super::{Quantity, arranged};
use unripple_core::Surface;
use unripple_linalg::{Cholesky, Mat, exact_symmetric};

/// Half of a 95 % interval in standard deviations.
const HALF: f64 = 1.96;

/// Logarithm of the factor either way at which an interval ends that is told by nothing: what a number can hold.
const WIDEST: f64 = 20.0;

/// Least share of a residual that its own frequency may leave to others: below, nothing else tells what it tells.
const ALONE: f64 = 1e-6;

/// A quantity as frequencies tell it, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedValue {
    /// Which quantity of the surface.
    pub quantity: Quantity,
    /// Its unit, as in `N/m`.
    pub unit: &'static str,
    /// The value found.
    pub value: f64,
    /// Ends of the interval that holds it with a probability of 95 %, given which mode each frequency is.
    pub interval: [f64; 2],
    /// The value of the surface file.
    pub nominal: f64,
}

/// A measured frequency, and the mode that it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchedMode {
    /// Index of the measured frequency, in the order given.
    pub heard: usize,
    /// Number of the mode from 0, without motions as a rigid body.
    pub mode: usize,
    /// Measured frequency in Hz.
    pub measured_hz: f64,
    /// Frequency of the fitted surface in Hz.
    pub computed_hz: f64,
    /// Logarithm of measured over computed frequency: the relative residual.
    pub residual: f64,
    /// Relative error of the prediction of this mode by a fit to all others, linearised; `None` where the others tell nothing of it.
    pub left_out: Option<f64>,
}

/// A surface that explains measured frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct Explained {
    /// The surface with the values found.
    pub surface: Surface,
    /// How its sides are held, in words.
    pub sides: String,
    /// The fitted quantities.
    pub values: Vec<FittedValue>,
    /// Measured frequencies and their modes, ascending.
    pub modes: Vec<MatchedMode>,
    /// Frequencies in Hz of modes below the highest assigned one that were not heard.
    pub missed_hz: Vec<f64>,
    /// Indices of measured frequencies that are no mode of the surface.
    pub spurious: Vec<usize>,
    /// Cost of the fit: the sum of the squared residuals over their standard deviation, and the prices of missed modes and spurious
    /// frequencies.
    pub cost: f64,
    /// Root mean square of the residuals over the error that was stated, per degree of freedom; intervals are wider by it where it is above
    /// 1.
    pub excess: f64,
}

impl Explained {
    pub(super) fn of(model: &Model<'_>, problem: &Problem, order: &[usize], solved: &Solved) -> Self {
        let surface = model.surface(&solved.logs);
        let (square, _) = normal(&solved.residuals, &solved.jacobian, problem.deviation);
        let covariance = Cholesky::new(square.as_ref()).map(|factor| factor.inverse());
        let excess = excess(solved, problem);
        let value = |(which, quantity): (usize, &Quantity)| {
            let spread = covariance.as_ref().map_or(f64::INFINITY, |c| c[(which, which)].max(0.0).sqrt());
            let half = (HALF * spread * excess.max(1.0)).min(WIDEST);
            let value = quantity.value(&surface).unwrap_or(0.0);
            FittedValue {
                quantity: *quantity,
                unit: quantity.unit(&surface),
                value,
                interval: [value * (-half).exp(), value * half.exp()],
                nominal: quantity.value(model.nominal).unwrap_or(0.0),
            }
        };
        let pairs = &solved.matching.pairs;
        let last = pairs.last().map_or(0, |(_, mode)| *mode);
        let heard = |mode: usize| pairs.iter().any(|(_, j)| *j == mode);
        let used = |i: usize| pairs.iter().any(|(measured, _)| *measured == i);
        Self {
            sides: arranged::words(&surface.outline),
            values: model.free.iter().enumerate().map(value).collect(),
            modes: modes(problem, order, solved, covariance.as_ref()),
            missed_hz: (0..last).filter(|mode| !heard(*mode)).map(|mode| solved.computed.hz[mode]).collect(),
            spurious: (0..problem.logs.len()).filter(|i| !used(*i)).map(|i| order[i]).collect(),
            cost: solved.matching.cost,
            excess,
            surface,
        }
    }
}

/// Root mean square of the residuals over their stated deviation, per degree of freedom; 1 where there is none to spare.
fn excess(solved: &Solved, problem: &Problem) -> f64 {
    let spare = solved.residuals.len().saturating_sub(solved.logs.len());
    let sum: f64 = solved.residuals.iter().map(|residual| (residual / problem.deviation).powi(2)).sum();
    if spare == 0 { 1.0 } else { (sum / spare as f64).sqrt() }
}

/// The pairs of a fit, with the error of each if it were left out: r/(1 - H) with H its entry of the hat matrix (Allen's PRESS).
fn modes(
    problem: &Problem,
    order: &[usize],
    solved: &Solved,
    covariance: Option<&Mat<f64>>,
) -> Vec<MatchedMode> {
    let one = |(n, (i, j)): (usize, &(usize, usize))| {
        let row = &solved.jacobian[n];
        let own = |covariance: &Mat<f64>| {
            let count = row.len();
            let sum = |a: usize| (0..count).map(|b| row[a] * covariance[(a, b)] * row[b]).sum::<f64>();
            (0..count).map(sum).sum::<f64>() / problem.deviation.powi(2)
        };
        let rest = covariance.map(|covariance| 1.0 - own(covariance)).filter(|rest| *rest > ALONE);
        MatchedMode {
            heard: order[*i],
            mode: *j,
            measured_hz: problem.logs[*i].exp(),
            computed_hz: solved.computed.hz[*j],
            residual: solved.residuals[n],
            left_out: rest.map(|rest| solved.residuals[n] / rest),
        }
    };
    solved.matching.pairs.iter().enumerate().map(one).collect()
}

/// The direction in the logarithms of the factors that frequencies tell least, of unit length, and its standard deviation (infinite where
/// they tell nothing).
pub(super) fn weakest(solved: &Solved, problem: &Problem) -> Option<(Vec<f64>, f64)> {
    let count = solved.logs.len();
    if solved.jacobian.is_empty() {
        return Some(((0..count).map(|a| if a == 0 { 1.0 } else { 0.0 }).collect(), f64::INFINITY));
    }
    let (square, _) = normal(&solved.residuals, &solved.jacobian, problem.deviation);
    let (values, vectors) = exact_symmetric(square.as_ref())?;
    let least = *values.first()?;
    let direction = (0..count).map(|a| vectors[(a, 0)]).collect();
    Some((direction, if least > 0.0 { 1.0 / least.sqrt() } else { f64::INFINITY }))
}
