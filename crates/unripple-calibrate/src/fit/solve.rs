use super::layout::Values;
use super::residual::{Case, Residual};
use crate::CalibrateError;
use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Mat, Side};

/// Steps of one descent, and what change of the cost ends it.
const STEPS: usize = 12;
const SETTLED: f64 = 1e-3;

/// The least trust in a step before the descent is given up.
const STUCK: f64 = 1e6;

/// Values that fit, and how well.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub values: Values,
    /// Residual over noise: the root of chi squared per degree of freedom.
    pub excess: f64,
    /// Residual over what was measured.
    pub share: f64,
    pub residual: Residual,
}

impl Case<'_> {
    /// The values that fit best, by Levenberg and Marquardt's method, each unknown held to what it is thought to be.
    ///
    /// Where the residual stays above the noise, the noise counts as that much larger, so that a wrong model does not overrule
    /// what is thought.
    pub fn descend(&self, start: &Values, expected: &Values) -> Result<Found, CalibrateError> {
        let mut values = start.clone();
        let mut residual = self.linear(&values)?;
        let (mut damping, mut steps) = (1e-3, 0);
        'descent: while steps < STEPS {
            let excess = self.excess(&residual).max(1.0);
            let cost = |r: &Residual, v: &Values| {
                square(&r.values) / excess.powi(2) + square(&self.offsets(v, expected))
            };
            let before = cost(&residual, &values);
            let (system, downhill) = self.normal(&residual, &self.offsets(&values, expected), excess);
            loop {
                let step = solve(&system, &downhill, damping)?;
                let trial = self.moved(&values, step.col(0).iter());
                let after = self.residual(&trial).map(|r| cost(&r, &trial)).unwrap_or(f64::INFINITY);
                steps += 1;
                if after < before {
                    damping = (damping * 0.1).max(1e-9);
                    values = trial;
                    residual = self.linear(&values)?;
                    if before - after < SETTLED * before {
                        break 'descent;
                    }
                    break;
                }
                damping *= 10.0;
                if damping > STUCK || steps >= STEPS {
                    break 'descent;
                }
            }
        }
        let (excess, share) = (self.excess(&residual), (square(&residual.values) / residual.power).sqrt());
        Ok(Found { values, excess, share, residual })
    }

    /// Residual over noise.
    pub fn excess(&self, residual: &Residual) -> f64 {
        let free = (residual.data - self.layout.unknowns().len() as f64).max(1.0);
        (square(&residual.values) / free).sqrt()
    }

    /// JᵀJ/κ² + 1 and -(Jᵀr/κ² + z).
    pub fn normal(&self, residual: &Residual, offsets: &[f64], excess: f64) -> (Mat<f64>, Mat<f64>) {
        let weight = 1.0 / excess.powi(2);
        let mut system = weight * (residual.slopes.transpose() * &residual.slopes);
        let values = Mat::from_fn(residual.values.len(), 1, |i, _| residual.values[i]);
        let mut downhill = -weight * (residual.slopes.transpose() * values);
        for (i, offset) in offsets.iter().enumerate() {
            system[(i, i)] += 1.0;
            downhill[(i, 0)] -= offset;
        }
        (system, downhill)
    }

    /// Covariance of the unknowns in units of their spreads.
    pub fn covariance(&self, found: &Found) -> Result<Mat<f64>, CalibrateError> {
        let overlap = self.spectra.overlap.sqrt();
        let none = vec![0.0; found.residual.slopes.ncols()];
        let (system, _) = self.normal(&found.residual, &none, found.excess.max(1.0) * overlap);
        Ok(system.llt(Side::Lower).map_err(|_| singular())?.inverse())
    }

    /// How far values are from those expected, in spreads.
    fn offsets(&self, values: &Values, expected: &Values) -> Vec<f64> {
        let (mut values, mut expected) = (values.clone(), expected.clone());
        let unknowns = self.layout.unknowns().into_iter();
        unknowns.map(|u| (*values.of(u) - *expected.of(u)) / self.layout.spread(u)).collect()
    }

    fn moved<'s>(&self, values: &Values, step: impl Iterator<Item = &'s f64>) -> Values {
        let mut moved = values.clone();
        for (unknown, step) in self.layout.unknowns().into_iter().zip(step) {
            *moved.of(unknown) += step * self.layout.spread(unknown);
        }
        moved
    }
}

/// Solves a positive definite system, its diagonal raised by a share.
pub(super) fn solve(system: &Mat<f64>, right: &Mat<f64>, damping: f64) -> Result<Mat<f64>, CalibrateError> {
    let mut damped = system.clone();
    (0..damped.nrows()).for_each(|i| damped[(i, i)] *= 1.0 + damping);
    Ok(damped.llt(Side::Lower).map_err(|_| singular())?.solve(right))
}

fn singular() -> CalibrateError {
    CalibrateError::Unsolvable {
        what: "normal equations of the fit",
        expected: "a positive definite matrix",
        found: "one that is not: a signal without meaning".into(),
    }
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum()
}
