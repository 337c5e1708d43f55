//! Levenberg-Marquardt steps of the regularised least-squares problem, and standard errors.

use super::layout::Values;
use super::residual::{Case, Residual};
use crate::CalibrateError;
use unripple_core::Point;
use unripple_linalg::{Cholesky, Mat, times};

/// Steps of one descent, and what share of the cost its change is when it ends: on the way, and in the end, where it is far less than
/// what a standard error more would cost.
const STEPS: usize = 12;
const SETTLED: f64 = 1e-3;
const LAST_STEPS: usize = 40;
const LAST_CHANGE: f64 = 0.01;

/// Least residual over what was said of noise that errors are made of. Otherwise a measurement with overstated noise
/// would claim errors of nothing.
const LEAST: f64 = 0.05;

/// What groups say of errors is multiplied by, since the fit bends towards each of them and they are few: of 100 random truths 95 %
/// intervals then hold in about 95.
const FEW: f64 = 1.5;

/// How near to the rim a place may come, in metres. A tenth of a millimetre: on the rim itself modes of a clamped
/// sheet vanish, and with them all derivatives.
const INSIDE: f64 = 1e-4;

/// The least trust in a step before the descent is given up. With so much damping a step no longer changes any digit
/// that matters.
const STUCK: f64 = 1e6;

/// Values that fit, and how well.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// The values of the unknowns.
    pub values: Values,
    /// Residual over noise: the root of chi squared per degree of freedom.
    pub excess: f64,
    /// Residual over what was measured.
    pub share: f64,
    /// The residual at these values.
    pub residual: Residual,
}

impl Case<'_> {
    /// The values that fit best, by the Levenberg-Marquardt method, each unknown held to its prior.
    ///
    /// Where the residual stays above the noise, the noise counts as that much larger, so that a wrong model does not overrule
    /// the priors.
    pub fn descend(&self, start: &Values, expected: &Values, last: bool) -> Result<Found, CalibrateError> {
        let most = if last { LAST_STEPS } else { STEPS };
        let mut values = start.clone();
        let mut residual = self.linear(&values)?;
        let (mut damping, mut steps) = (1e-3, 0);
        'descent: while steps < most {
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
                    if before - after < if last { LAST_CHANGE } else { SETTLED * before } {
                        break 'descent;
                    }
                    break;
                }
                damping *= 10.0;
                if damping > STUCK || steps >= most {
                    break 'descent;
                }
            }
        }
        let (excess, share) = (self.excess(&residual), (square(&residual.values) / residual.power).sqrt());
        Ok(Found { values, excess, share, residual })
    }

    /// Residual over noise, a ratio: the root of chi squared per degree of freedom.
    pub fn excess(&self, residual: &Residual) -> f64 {
        let free = (residual.data - self.layout.unknowns().len() as f64).max(1.0);
        (square(&residual.values) / free).sqrt()
    }

    /// The damped normal equations JᵀJ/κ² + 1 and -(Jᵀr/κ² + z), unknowns x unknowns and unknowns x 1.
    pub fn normal(&self, residual: &Residual, offsets: &[f64], excess: f64) -> (Mat<f64>, Mat<f64>) {
        let weight = 1.0 / excess.powi(2);
        let mut system = weight * times(residual.slopes.transpose(), residual.slopes.as_ref());
        let values = Mat::from_fn(residual.values.len(), 1, |i, _| residual.values[i]);
        let mut downhill = -weight * times(residual.slopes.transpose(), values.as_ref());
        for (i, offset) in offsets.iter().enumerate() {
            system[(i, i)] += 1.0;
            downhill[(i, 0)] -= offset;
        }
        (system, downhill)
    }

    /// Variances of the unknowns in units of the squares of their spreads.
    ///
    /// Once from the noise, as if the residual were white; once from how much responses pull apart, and once from how much
    /// frequencies do: with g_b = J_bᵀ r_b what each says of the unknowns, H⁻¹ (Σ g_b g_bᵀ) H⁻¹ (the sandwich
    /// estimator: White, *Econometrica* 48, 817, 1980, by groups). What a wrong model leaves is not white, and is
    /// alike in all responses at one frequency. The largest counts.
    pub fn variances(&self, found: &Found) -> Result<Vec<f64>, CalibrateError> {
        // The residual is a better estimate of the noise than what the caller said of it.
        let excess = found.excess.max(LEAST) * self.spectra.overlap.sqrt();
        let unknowns = found.residual.slopes.ncols();
        let (system, _) = self.normal(&found.residual, &vec![0.0; unknowns], excess);
        let inverse = Cholesky::new(system.as_ref()).ok_or_else(singular)?.inverse();
        let apart = [0, 1].map(|way| pulled_apart(&found.residual, way, &inverse, excess));
        let variance = |u: usize| {
            // The priors have their own share in these sums.
            let held: f64 = (0..unknowns).map(|v| inverse[(u, v)].powi(2)).sum();
            inverse[(u, u)].max(apart[0][u] + held).max(apart[1][u] + held).min(1.0)
        };
        Ok((0..unknowns).map(variance).collect())
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
        moved.places.iter_mut().for_each(|at| *at = self.inside(*at));
        moved
    }
}

/// Variances of the unknowns by how far groups of rows pull apart: responses (0) or frequencies (1).
fn pulled_apart(residual: &Residual, way: usize, inverse: &Mat<f64>, excess: f64) -> Vec<f64> {
    let unknowns = inverse.nrows();
    let groups = residual.belongs.iter().map(|row| row[way] + 1).max().unwrap_or(0);
    let mut pulls = Mat::<f64>::zeros(unknowns, groups);
    for u in 0..unknowns {
        let rows = residual.belongs.iter().zip(&residual.values).enumerate();
        rows.for_each(|(i, (row, value))| {
            pulls[(u, row[way])] += residual.slopes[(i, u)] * value / excess.powi(2);
        });
    }
    let moved = times(inverse.as_ref(), pulls.as_ref());
    (0..unknowns).map(|u| FEW * (0..groups).map(|b| moved[(u, b)].powi(2)).sum::<f64>()).collect()
}

impl Case<'_> {
    /// A place on the sheet: itself, or the nearest one a little inside the rim.
    fn inside(&self, at: Point) -> Point {
        let outline = &self.basis.outline;
        if outline.contains(at) {
            return at;
        }
        let rim = outline.nearest(at);
        let (width, height) = outline.extent();
        let middle = Point::new(width / 2.0, height / 2.0);
        let share = INSIDE / rim.distance(middle).max(INSIDE);
        let inner = Point::new(rim.x + share * (middle.x - rim.x), rim.y + share * (middle.y - rim.y));
        if outline.contains(inner) { inner } else { rim }
    }
}

/// Solves a positive definite system, its diagonal raised by a share.
pub(super) fn solve(system: &Mat<f64>, right: &Mat<f64>, damping: f64) -> Result<Mat<f64>, CalibrateError> {
    let mut damped = system.clone();
    (0..damped.nrows()).for_each(|i| damped[(i, i)] *= 1.0 + damping);
    let mut found = right.clone();
    Cholesky::new(damped.as_ref()).ok_or_else(singular)?.solve(found.as_mut());
    Ok(found)
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
