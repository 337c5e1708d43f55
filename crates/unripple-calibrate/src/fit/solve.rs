//! Levenberg-Marquardt steps of the regularised least-squares problem, and standard errors.

use super::layout::Values;
use super::residual::{Case, Residual};
use crate::CalibrateError;
use unripple_core::{Observed, Point};
use unripple_linalg::{Cholesky, Mat, product};

/// Largest number of steps of a descent, and the change of the cost that ends it: `STEPS` and `SETTLED`, a share of the cost, for all
/// descents but the last; `LAST_STEPS` and `LAST_CHANGE`, far less than the cost of one standard error, 1, for the last.
const STEPS: usize = 12;
const SETTLED: f64 = 1e-3;
const LAST_STEPS: usize = 40;
const LAST_CHANGE: f64 = 0.01;

/// Smallest residual, relative to the stated noise, from which standard errors are computed. Otherwise a
/// measurement with overstated noise would have errors near 0.
const LEAST: f64 = 0.05;

/// Factor of variances that are computed from groups of rows, since the groups are few and the fit follows each of them: with it, 95
/// % intervals contain the truth in about 95 of 100 random cases.
const FEW: f64 = 1.5;

/// Smallest distance of a place from the rim of the sheet, in metres. A tenth of a millimetre: on the rim itself modes of a clamped
/// sheet vanish, and with them all derivatives.
const INSIDE: f64 = 1e-4;

/// Damping of a Levenberg-Marquardt step above which the descent ends: a step with so much damping no longer
/// changes any digit that matters.
const STUCK: f64 = 1e6;

/// Result of a least-squares fit by the Levenberg-Marquardt method: fitted values and their residual.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// The fitted values of the unknowns.
    pub values: Values,
    /// Rms residual relative to noise: the root of chi squared per degree of freedom.
    pub excess: f64,
    /// Rms residual, relative to the rms of the measurement.
    pub share: f64,
    /// The residual at the fitted values.
    pub residual: Residual,
}

impl Case<'_> {
    /// The values that fit best, by the Levenberg-Marquardt method from `start`, each unknown with its prior
    /// around `expected`. `last` selects the accuracy of the final fit.
    ///
    /// Where the residual stays above the noise, the noise counts as that much larger, so that a wrong model does not overrule
    /// the priors.
    pub fn descend(&self, start: &Values, expected: &Values, last: bool) -> Result<Found, CalibrateError> {
        let most = if last { LAST_STEPS } else { STEPS };
        let observed = Observed::here();
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
                observed.done(steps as f64 / most as f64);
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

    /// Rms residual relative to noise: the root of chi squared per degree of freedom.
    pub fn excess(&self, residual: &Residual) -> f64 {
        let free = (residual.data - self.layout.unknowns().len() as f64).max(1.0);
        (square(&residual.values) / free).sqrt()
    }

    /// The normal equations with priors: the matrix JᵀJ/κ² + 1, unknowns x unknowns, and the right side -(Jᵀr/κ² + z), unknowns x 1.
    /// J and r are slopes and values of the residual, κ is `excess`, z is `offsets`.
    pub fn normal(&self, residual: &Residual, offsets: &[f64], excess: f64) -> (Mat<f64>, Mat<f64>) {
        let weight = 1.0 / excess.powi(2);
        let mut system = weight * product(residual.slopes.transpose(), residual.slopes.as_ref());
        let values = Mat::from_fn(residual.values.len(), 1, |i, _| residual.values[i]);
        let mut downhill = -weight * product(residual.slopes.transpose(), values.as_ref());
        for (i, offset) in offsets.iter().enumerate() {
            system[(i, i)] += 1.0;
            downhill[(i, 0)] -= offset;
        }
        (system, downhill)
    }

    /// Variances of the fitted unknowns, each as a share (at most 1) of the variance of the unknown's prior.
    ///
    /// The largest of three estimates counts: from the noise, as if the residual were white; from the scatter between responses; and
    /// from the scatter between frequencies. The latter two are H⁻¹ (Σ g_b g_bᵀ) H⁻¹, with H the normal matrix and g_b = J_bᵀ r_b the
    /// gradient of group b (the sandwich estimator: White, *Econometrica* 48, 817, 1980, by groups). The residual of a wrong model is
    /// not white, and is similar in all responses at one frequency.
    pub fn variances(&self, found: &Found) -> Result<Vec<f64>, CalibrateError> {
        // The residual is a better estimate of the noise than the stated one.
        let excess = found.excess.max(LEAST) * self.spectra.overlap.sqrt();
        let unknowns = found.residual.slopes.ncols();
        let (system, _) = self.normal(&found.residual, &vec![0.0; unknowns], excess);
        let inverse = Cholesky::new(system.as_ref()).ok_or_else(singular)?.inverse();
        let apart = [0, 1].map(|way| pulled_apart(&found.residual, way, &inverse, excess));
        let variance = |u: usize| {
            // Contribution of the priors to these sums.
            let held: f64 = (0..unknowns).map(|v| inverse[(u, v)].powi(2)).sum();
            inverse[(u, u)].max(apart[0][u] + held).max(apart[1][u] + held).min(1.0)
        };
        Ok((0..unknowns).map(variance).collect())
    }

    /// Distance of each unknown from its expected value, in standard deviations of its prior, `[unknown]`.
    pub fn offsets(&self, values: &Values, expected: &Values) -> Vec<f64> {
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

/// Variances of the unknowns from the scatter between groups of rows: responses (`way` 0) or frequencies (1).
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
    let moved = product(inverse.as_ref(), pulls.as_ref());
    (0..unknowns).map(|u| FEW * (0..groups).map(|b| moved[(u, b)].powi(2)).sum::<f64>()).collect()
}

impl Case<'_> {
    /// The place `at` if it lies on the sheet, otherwise the nearest place a little inside the rim.
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

/// Solves a positive definite system whose diagonal is multiplied by 1 + `damping`.
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
        found: "one that is not: responses may hold values that are not finite".into(),
    }
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum()
}
