//! The grid of points on which modal fields are evaluated.

use crate::FieldError;
use unripple_core::{Conditions, Point, require};

/// Largest number of cells of a grid: the field in each is evaluated at every sample. With twice this value,
/// the largest fields take twice the time.
const MOST_CELLS: f64 = 4e6;

/// A grid of rectangular cells over the bounding box of a surface; fields are evaluated at the centres of the cells
/// inside the outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// Width of a cell, in metres.
    pub width: f64,
    /// Height of a cell, in metres.
    pub height: f64,
    /// Cells whose centres are inside the outline, row by row from the bottom: `row · columns + column`.
    pub inside: Vec<usize>,
}

impl Grid {
    /// A grid of `ceil(cells · L / λ_min)` cells along each side L of the outline's bounding box.
    ///
    /// # Errors
    /// [`FieldError::Range`] if `cells` or the conditions' lengths are not positive, or make too many cells.
    pub fn new(conditions: &Conditions, cells: f64) -> Result<Self, FieldError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let wavelength = conditions.lambda_min;
        require("cells per wavelength", positive(cells), "a positive number", cells)?;
        require("shortest wavelength (m)", positive(wavelength), "a positive number", wavelength)?;
        let (across, up) = conditions.outline.extent();
        require("width of the surface (m)", positive(across), "a positive number", across)?;
        require("height of the surface (m)", positive(up), "a positive number", up)?;
        let (columns, rows) = ((cells * across / wavelength).ceil(), (cells * up / wavelength).ceil());
        require(
            "cells of the grid",
            columns * rows <= MOST_CELLS,
            format!("at most {MOST_CELLS}"),
            columns * rows,
        )?;
        let (columns, rows) = (columns as usize, rows as usize);
        let mut grid = Self {
            columns,
            rows,
            width: across / columns as f64,
            height: up / rows as f64,
            inside: Vec::new(),
        };
        grid.inside =
            (0..columns * rows).filter(|cell| conditions.outline.contains(grid.centre(*cell))).collect();
        Ok(grid)
    }

    /// Centre of a cell, given by its index, in metres.
    pub fn centre(&self, cell: usize) -> Point {
        let (column, row) = (cell % self.columns, cell / self.columns);
        Point::new((column as f64 + 0.5) * self.width, (row as f64 + 0.5) * self.height)
    }

    /// The points of the grid, in metres: centres of the cells inside the outline.
    pub fn points(&self) -> Vec<Point> {
        self.inside.iter().map(|cell| self.centre(*cell)).collect()
    }

    /// Distributes one value per point of the grid to all cells, `[row · columns + column]` from the bottom;
    /// cells outside the outline are NaN.
    pub fn spread<T: Copy + Into<f64>>(&self, values: &[T]) -> Vec<f64> {
        let mut cells = vec![f64::NAN; self.columns * self.rows];
        self.inside.iter().zip(values).for_each(|(cell, value)| cells[*cell] = (*value).into());
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Outline, Shape};

    fn conditions(shape: Shape) -> Conditions {
        Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 14.55e-3, outline: Outline::new(shape) }
    }

    #[test]
    fn the_papers_film_has_83_cells_a_side() {
        let grid = Grid::new(&conditions(Shape::Rectangle { width: 0.15, height: 0.15 }), 8.0).unwrap();
        assert_eq!((grid.columns, grid.rows, grid.inside.len()), (83, 83, 6889));
        let last = grid.points()[6888];
        assert!(last.distance(Point::new(0.15 - grid.width / 2.0, 0.15 - grid.height / 2.0)) < 1e-12);
    }

    #[test]
    fn round_surfaces_leave_corners_out() {
        let grid = Grid::new(&conditions(Shape::Circle { radius: 0.07 }), 8.0).unwrap();
        let share = grid.inside.len() as f64 / (grid.columns * grid.rows) as f64;
        assert!((share - std::f64::consts::PI / 4.0).abs() < 0.01, "{share}");
        let cells = grid.spread(&vec![1.0_f32; grid.inside.len()]);
        assert!(cells[0].is_nan());
        assert_eq!(cells.iter().filter(|c| !c.is_nan()).sum::<f64>(), grid.inside.len() as f64);
    }

    #[test]
    fn refuses_grids_without_end() {
        let flat = conditions(Shape::Rectangle { width: 0.15, height: 0.15 });
        for cells in [0.0, -8.0, f64::NAN, 1e9] {
            assert!(matches!(Grid::new(&flat, cells), Err(FieldError::Range(_))), "{cells}");
        }
        let zero = Conditions { lambda_min: 0.0, ..flat };
        assert!(Grid::new(&zero, 8.0).is_err());
    }
}
