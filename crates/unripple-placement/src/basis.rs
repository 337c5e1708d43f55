//! The quantities of a surface's modes from which time reversal is computed, for all actuators and targets.

use crate::PlacementError;
use crate::mounting::Inputs;
use rayon::prelude::*;
use std::sync::Arc;
use unripple_core::{Conditions, Point, Shapes, window_samples};
use unripple_dsp::Correlations;
use unripple_field::Grid;
use unripple_linalg::{Mat, MatRef, product};

/// Cells of the grid of the field per shortest wavelength. Products of two shapes have half that wavelength, with two cells on it; with
/// twice this value, contrasts change by 2 % rms, and it takes four times as long.
const CELLS: f64 = 4.0;

/// Products of a surface's modes: of their impulse responses, summed over the window, and of their shapes,
/// averaged over the grid.
#[derive(Debug)]
pub struct Basis {
    /// Sums over the window of the products of two modes' impulse responses, relative to the largest.
    sums: Mat<f32>,
    /// Mean, over the points of the grid, of the products of two shapes, times their number.
    everywhere: Mat<f64>,
    /// Points of the grid.
    points: Vec<Point>,
    shapes: Arc<dyn Shapes>,
    conditions: Conditions,
    /// Divisor of the sums and of the input weights.
    scale: f64,
}

/// The quantities of one target from which, with the [`Basis`], time reversal to it is computed.
#[derive(Debug)]
pub struct Aimed {
    /// Shape weights at the target, relative to the largest.
    pub shape: Vec<f32>,
    /// Mean of the products of two shapes over the points outside the focal disc, relative to the square of that largest weight.
    pub outside: Mat<f32>,
    /// Factor that converts peaks to m²/s² per squared unit of drive, summed over samples.
    pub unit: f64,
}

impl Basis {
    /// Computes these products for a window (s).
    ///
    /// # Errors
    /// [`PlacementError::Field`] for a surface too large for a grid.
    pub fn new(inputs: &Inputs, window: f64) -> Result<Self, PlacementError> {
        let (modal, conditions) = (&inputs.nominal, inputs.nominal.conditions.clone());
        let sums =
            Correlations::new(&modal.poles, conditions.rate, window_samples(window, conditions.rate) + 1);
        let modes = modal.poles.len();
        let rows = (0..modes).into_par_iter().map(|i| (0..=i).map(|j| sums.of(i, j)).collect());
        let rows: Vec<Vec<f64>> = rows.collect();
        let largest = (0..modes).map(|i| rows[i][i]).fold(f64::MIN_POSITIVE, f64::max);
        let sums = Mat::from_fn(modes, modes, |i, j| (rows[i.max(j)][i.min(j)] / largest) as f32);
        let points = Grid::new(&conditions, CELLS)?.points();
        let on_grid = modal.shapes.at_all(&points);
        let everywhere = product(on_grid.transpose(), on_grid.as_ref());
        let scale = largest * inputs.largest().powi(2);
        Ok(Self { sums, everywhere, points, shapes: modal.shapes.clone(), conditions, scale })
    }

    /// Sums over the window of the products of two modes' impulse responses, relative to the largest.
    pub fn sums(&self) -> MatRef<'_, f32> {
        self.sums.as_ref()
    }

    /// Mode shapes at the target `at` (m), and their mean products outside its focal disc.
    ///
    /// # Errors
    /// [`PlacementError::Target`] if no point of the grid is outside its focal disc.
    pub fn aimed(&self, at: Point) -> Result<Aimed, PlacementError> {
        let radius = self.conditions.focal_radius();
        let inside: Vec<Point> = self.points.iter().copied().filter(|p| p.distance(at) <= radius).collect();
        let outside = self.points.len() - inside.len();
        if outside == 0 {
            return Err(PlacementError::Target {
                at,
                expected: "a part of the surface outside its focal disc",
            });
        }
        let shape = self.shapes.at_all(&[at]);
        let largest = shape.row(0).iter().fold(f64::MIN_POSITIVE, |most, w| most.max(w.abs()));
        let within = self.shapes.at_all(&inside);
        let within = product(within.transpose(), within.as_ref());
        let scale = 1.0 / (outside as f64 * largest * largest);
        let outside = Mat::from_fn(self.sums.nrows(), self.sums.nrows(), |i, j| {
            (scale * (self.everywhere[(i, j)] - within[(i, j)])) as f32
        });
        let shape = shape.row(0).iter().map(|weight| (weight / largest) as f32).collect();
        Ok(Aimed { shape, outside, unit: self.scale * largest * largest })
    }
}
