//! Least squares with levels held exactly and bounds at control points.

use super::background::dot;
use super::control::Control;
use super::watch::{Sample, Watch};
use crate::FocusError;
use unripple_linalg::{Mat, MatRef, non_negative, solve_upper_alone};

/// Tolerance, as a share of the ceiling, by which the largest felt displacement may exceed it: 0.26 dB.
/// Halved, about one more round is needed.
const SLACK: f64 = 0.03;

/// Largest number of rounds of the search for displacements above the ceiling; some five are enough. With
/// twice this value, a search that does not converge takes twice as long.
const ROUNDS: usize = 40;

/// In the first round, maxima above this share of the largest one are bounded. Nearer to 1, fewer are
/// bounded at once and more rounds are needed.
const FIRST: f64 = 0.6;

/// Regularisation that keeps the equations of neighbouring samples solvable, as a share of the mean square
/// of a row. Larger, the felt displacement there would stay above the ceiling.
const ROUNDING: f64 = 1e-9;

/// A target is inseparable from the others if less than this share (-60 dB) of its squared level is
/// independent of theirs. Larger, targets would be refused that take much drive but can be reached.
const OWN: f64 = 1e-6;

/// Prescribed levels as constraints on whitened coefficients z: the z of least |z|² that has the levels, and
/// the directions of z that would change them.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    /// The z of least |z|² with the levels requested.
    least: Vec<f64>,
    /// Orthonormal directions that change levels.
    directions: Vec<Vec<f64>>,
}

impl Held {
    /// Solves for the vector z of least norm that has these levels, by Gram-Schmidt orthogonalisation, done
    /// twice for accuracy. Row k of `rows` holds the change of level k per whitened coefficient.
    ///
    /// # Errors
    /// [`FocusError::Inseparable`].
    pub fn new(rows: &[Vec<f64>], levels: &[f64]) -> Result<Self, FocusError> {
        let mut held = Self { least: Vec::new(), directions: Vec::new() };
        let mut least = vec![0.0; rows.first().map_or(0, Vec::len)];
        for (target, (row, level)) in rows.iter().zip(levels).enumerate() {
            let mut own = row.clone();
            held.clear(&mut own);
            held.clear(&mut own);
            let size = dot(&own, &own);
            if size < OWN * dot(row, row) {
                let shared = |i: &usize| dot(&held.directions[*i], row).abs();
                let other = (0..target).max_by(|a, b| shared(a).total_cmp(&shared(b))).unwrap_or(0);
                return Err(FocusError::Inseparable { target, other });
            }
            own.iter_mut().for_each(|x| *x /= size.sqrt());
            let missing = (level - dot(row, &least)) / dot(row, &own);
            least.iter_mut().zip(&own).for_each(|(z, d)| *z += missing * d);
            held.directions.push(own);
        }
        held.least = least;
        Ok(held)
    }

    /// Removes from `row` the components that would change a level.
    fn clear(&self, row: &mut [f64]) {
        for direction in &self.directions {
            let share = dot(direction, row);
            row.iter_mut().zip(direction).for_each(|(x, d)| *x -= share * d);
        }
    }
}

/// The quadratic programme of one drive: least |z|² + worst · s² with the levels fixed and no felt
/// displacement above s outside the targets.
#[derive(Debug)]
pub(crate) struct Programme<'a> {
    /// Felt displacement around the focal instant, per coefficient of the drive.
    pub watch: &'a Watch,
    /// Control points at which the felt displacement is evaluated.
    pub control: &'a Control,
    /// Lower triangular Cholesky factor L of the cost of the spline coefficients c: whitened coefficients z
    /// give c = L⁻ᵀz and the cost |z|².
    pub factor: MatRef<'a, f64>,
    /// Weight of the largest felt displacement outside the targets, squared, in the cost.
    pub worst: f64,
}

/// Samples in space and time that have been bounded by the ceiling so far.
#[derive(Debug, Default)]
struct Bounds {
    samples: Vec<Sample>,
    /// Felt displacement at each sample per whitened coefficient, without components that would change a
    /// level.
    rows: Vec<Vec<f64>>,
    /// Felt displacement at each sample for the least z.
    slope: Vec<f64>,
    /// Products of rows, the lower triangle.
    products: Vec<Vec<f64>>,
    multipliers: Vec<f64>,
}

impl Programme<'_> {
    /// Spline coefficients of the optimal drive; the largest felt displacement is searched for at the
    /// control points with the indices `chosen`.
    ///
    /// Cutting planes: maxima of what is felt that rise above the ceiling s are bounded, and the programme with all bounds so
    /// far is solved through its dual, one multiplier λ ≥ 0 per bound, s = Σλ / worst and z = least − Σλ·row. The
    /// objective that it has then is a lower bound of the optimum, and what is felt above s the gap.
    pub fn solve(&self, held: &Held, chosen: &[usize]) -> Vec<f64> {
        let mut z = held.least.clone();
        let mut coefficients = self.coefficients(&z);
        if self.worst == 0.0 || chosen.is_empty() {
            return coefficients;
        }
        let modes = self.control.shapes.nrows();
        let shapes = Mat::from_fn(modes, chosen.len(), |m, p| self.control.shapes[(m, chosen[p])]);
        let (mut bounds, mut ceiling) = (Bounds::default(), 0.0);
        for _ in 0..ROUNDS {
            let field = self.watch.field(&coefficients, &shapes);
            let least = |largest: f64| {
                if bounds.samples.is_empty() { FIRST * largest } else { ceiling * (1.0 + SLACK / 4.0) }
            };
            let (largest, new) = self.watch.peaks(&field, self.control, chosen, &bounds.samples, least);
            if largest <= ceiling * (1.0 + SLACK) || new.is_empty() {
                break;
            }
            for sample in new {
                bounds.add(sample, self.watch.row(self.control, sample), held);
            }
            bounds.balance(self.worst);
            ceiling = bounds.multipliers.iter().sum::<f64>() / self.worst;
            z.copy_from_slice(&held.least);
            for (row, weight) in bounds.rows.iter().zip(&bounds.multipliers).filter(|(_, l)| **l > 0.0) {
                z.iter_mut().zip(row).for_each(|(z, x)| *z -= weight * x);
            }
            coefficients = self.coefficients(&z);
        }
        coefficients
    }

    fn coefficients(&self, z: &[f64]) -> Vec<f64> {
        let mut column = Mat::from_fn(z.len(), 1, |i, _| z[i]);
        solve_upper_alone(self.factor.transpose(), column.as_mut());
        column.col_as_slice(0).to_vec()
    }
}

impl Bounds {
    /// Adds a bound on one more sample.
    fn add(&mut self, sample: Sample, mut row: Vec<f64>, held: &Held) {
        self.slope.push(dot(&row, &held.least));
        held.clear(&mut row);
        self.samples.push(sample);
        self.rows.push(row);
        let last = &self.rows[self.rows.len() - 1];
        self.products.push(self.rows.iter().map(|other| dot(other, last)).collect());
        self.multipliers.push(0.0);
    }

    /// Solves the dual for the multipliers of all bounds so far.
    fn balance(&mut self, worst: f64) {
        let squares = self.products.iter().map(|row| row.last().copied().unwrap_or(0.0)).sum::<f64>();
        let rounding = ROUNDING * squares / self.products.len().max(1) as f64;
        let products = &self.products;
        let form = |i: usize, j: usize| {
            products[i.max(j)][i.min(j)] + 1.0 / worst + if i == j { rounding } else { 0.0 }
        };
        self.multipliers = non_negative(form, &self.slope, std::mem::take(&mut self.multipliers));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_held_and_no_more() {
        let rows = [vec![1.0, 2.0, 0.0, -1.0], vec![0.5, -1.0, 3.0, 0.0]];
        let held = Held::new(&rows, &[1.0, -0.25]).unwrap();
        assert!((dot(&rows[0], &held.least) - 1.0).abs() < 1e-12);
        assert!((dot(&rows[1], &held.least) + 0.25).abs() < 1e-12);
        // The least: nothing of it lies across the rows.
        let mut across = held.least.clone();
        held.clear(&mut across);
        assert!(across.iter().all(|x| x.abs() < 1e-12));
        let twice = [rows[0].clone(), rows[0].iter().map(|x| 2.0 * x).collect()];
        assert_eq!(
            Held::new(&twice, &[1.0, 1.0]).unwrap_err(),
            FocusError::Inseparable { target: 1, other: 0 }
        );
    }
}
