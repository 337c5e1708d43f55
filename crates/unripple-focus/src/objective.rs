//! Cost of a state of the surface: velocity outside the targets and energy of the drive, with the targets'
//! levels as constraints.

use crate::FocusError;
use crate::state::State;
use unripple_core::{Conditions, Point};
use unripple_linalg::{Cholesky, Mat, MatRef, Scale, add_square, product, squared_norm};

/// Smallest weight of energy in the objective, so that a drive of least velocity outside exists. Larger, the
/// strongest concentration is less strong; smaller, A is singular but for rounding.
const LEAST: f64 = 1e-9;

/// Share of the diagonal added to the system of levels, for points closer to each other than waves can tell
/// apart (Tikhonov regularisation). Larger, levels of such points are met less well.
const RIDGE: f64 = 1e-9;

/// Velocities required at points, as linear constraints on a state y: `Pᵀ y = γ`.
#[derive(Debug)]
pub(crate) struct Levels {
    /// The matrix P, rank x levels: each column gives the velocity at one point as a linear function of the
    /// state.
    pub readout: Mat<f64>,
    /// The velocities γ required, in m/s.
    pub wanted: Vec<f64>,
    /// The points at which the velocities are required, in metres.
    pub points: Vec<Point>,
}

/// Quadratic cost of a state y, velocity regularised by energy (Tikhonov):
/// `yᵀ A y = κ · velocity² + (1 - κ) · e · energy`.
///
/// velocity² is the mean square over the cells of all plants; κ is 0 for time reversal and 1 for velocity alone. With K
/// the mean of `x xᵀ` over the cells of the nominal surface, x their readouts, `e = tr K² / tr K` is the mean square
/// velocity per energy of time reversal, averaged over targets. So κ means the same on every surface, whatever
/// coordinates its state is written in.
#[derive(Debug)]
pub(crate) struct Objective {
    /// A over all cells, with no focal disc left out, rank x rank; its Cholesky factor is `factor`.
    whole: Mat<f64>,
    factor: Cholesky,
    /// `(1 - κ) e`.
    pub(crate) energy: f64,
    /// Scaled readouts q of the cells, rank x cells, one matrix per plant: leaving a cell out subtracts `q qᵀ` from A.
    cells: Vec<Mat<f64>>,
    points: Vec<Point>,
    radius: f64,
}

impl Objective {
    /// Computes what does not depend on the targets. With `all`, cells of the surface within the focal discs
    /// of targets count as well.
    ///
    /// # Errors
    /// [`FocusError::Decomposition`] if A is not positive definite.
    pub fn new(
        state: &State<'_>,
        strength: f64,
        conditions: &Conditions,
        all: bool,
    ) -> Result<Self, FocusError> {
        let rank = state.rank();
        let mut whole = Mat::<f64>::zeros(rank, rank);
        let (mut cells, mut places, mut unit) = (Vec::new(), Vec::new(), 0.0);
        for plant in 0..state.plants() {
            let (readout, points) = state.cells(plant);
            let share = 1.0 / (points.len() * state.plants()) as f64;
            let scaled = readout * Scale(share.sqrt());
            let square = product(scaled.as_ref(), scaled.transpose());
            if plant == 0 {
                let trace = (0..rank).map(|i| square[(i, i)]).sum::<f64>();
                unit = state.plants() as f64 * squared_norm(square.as_ref()) / trace;
                places = points;
            }
            whole += square * Scale(strength);
            cells.push(scaled * Scale(strength.sqrt()));
        }
        let energy = (1.0 - strength).max(LEAST) * unit;
        (0..rank).for_each(|i| whole[(i, i)] += energy);
        let factor = Cholesky::new(whole.as_ref()).ok_or(FocusError::Decomposition)?;
        let radius = if all { -1.0 } else { conditions.focal_radius() };
        Ok(Self { whole, factor, energy, cells, points: places, radius })
    }

    /// The lower triangle of the cost matrix A (rank x rank), without the surface cells in the focal discs
    /// of `targets` (m).
    pub fn around(&self, targets: &[Point]) -> Mat<f64> {
        let inside: Vec<usize> = (0..self.points.len())
            .filter(|c| targets.iter().any(|at| at.distance(self.points[*c]) <= self.radius))
            .collect();
        let mut matrix = self.whole.clone();
        for cells in &self.cells {
            let mut left = Mat::<f64>::zeros(cells.nrows(), inside.len());
            for (to, from) in inside.iter().enumerate() {
                left.col_as_slice_mut(to).copy_from_slice(cells.col_as_slice(*from));
            }
            add_square(matrix.as_mut(), -1.0, left.as_ref());
        }
        matrix
    }

    /// The state of least cost that has these levels: `y = A⁻¹ P μ`, μ from `Pᵀ A⁻¹ P μ = γ`.
    ///
    /// # Errors
    /// [`FocusError::Decomposition`] if A is not positive definite.
    pub fn least(&self, levels: &Levels) -> Result<Mat<f64>, FocusError> {
        let mut solved = levels.readout.clone();
        if self.radius < 0.0 {
            self.factor.solve(solved.as_mut());
        } else {
            let matrix = self.around(&levels.points);
            let factor = Cholesky::new(matrix.as_ref()).ok_or(FocusError::Decomposition)?;
            factor.solve(solved.as_mut());
        }
        level(solved, levels)
    }
}

/// Combines states linearly so that levels are met: `y = X μ` with `Pᵀ X μ = γ`.
///
/// # Errors
/// [`FocusError::Decomposition`] if no combination meets them.
fn level(states: Mat<f64>, levels: &Levels) -> Result<Mat<f64>, FocusError> {
    let mut system = product(levels.readout.transpose(), states.as_ref());
    let count = system.nrows();
    let mean = (0..count).map(|k| system[(k, k)]).sum::<f64>() / count.max(1) as f64;
    if count > 1 {
        (0..count).for_each(|k| system[(k, k)] += RIDGE * mean);
    }
    let factor = Cholesky::new(system.as_ref()).ok_or(FocusError::Decomposition)?;
    let mut factors = Mat::from_fn(count, 1, |k, _| levels.wanted[k]);
    factor.solve(factors.as_mut());
    Ok(product(states.as_ref(), factors.as_ref()))
}

/// The velocities `Pᵀ y` of a state y, one number per level.
pub(crate) fn read(readout: MatRef<'_, f64>, y: MatRef<'_, f64>) -> Vec<f64> {
    product(readout.transpose(), y).col_as_slice(0).to_vec()
}
