//! Values on a regular grid of cells.

use crate::PlotError;
use crate::error::{same_length, some_finite};

/// Values on a regular grid of cells, such as a field over a surface. Cells off the surface hold not-a-number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// Centre of the lower left cell, in the grid's unit of length.
    pub first: [f64; 2],
    /// Width and height of a cell, positive, in the grid's unit of length.
    pub pitch: [f64; 2],
    /// `rows x columns` values, row by row, row 0 at the bottom.
    pub values: Vec<f64>,
}

impl Grid {
    /// The bounding box of all cells: lower left and upper right corners, in the grid's unit of length.
    pub fn corners(&self) -> [[f64; 2]; 2] {
        let [x, y] = self.first;
        let [dx, dy] = self.pitch;
        let (columns, rows) = (self.columns as f64, self.rows as f64);
        [[x - dx / 2.0, y - dy / 2.0], [x + (columns - 0.5) * dx, y + (rows - 0.5) * dy]]
    }

    /// Centre `[x, y]` of a cell, in the grid's unit of length.
    pub fn centre(&self, column: usize, row: usize) -> [f64; 2] {
        [self.first[0] + column as f64 * self.pitch[0], self.first[1] + row as f64 * self.pitch[1]]
    }

    pub(crate) fn check(&self, what: &str) -> Result<(), PlotError> {
        same_length(what, self.columns.saturating_mul(self.rows), self.values.len())?;
        some_finite(what, &self.values)?;
        let corners = self.corners();
        for found in self.pitch {
            if !(found > 0.0 && corners.iter().flatten().all(|v| v.abs() < 1e12)) {
                let expected = "a positive size of cell, and places within 10¹²";
                return Err(PlotError::Range { what: what.to_owned(), expected, found });
            }
        }
        Ok(())
    }
}

/// A closed polygon: its corners in order.
pub type Ring = Vec<[f64; 2]>;

/// Whether a point is inside an odd number of rings.
pub(crate) fn inside(rings: &[Ring], [x, y]: [f64; 2]) -> bool {
    let crossings = |ring: &Ring| {
        let next = ring.iter().cycle().skip(1);
        ring.iter()
            .zip(next)
            .filter(|([x0, y0], [x1, y1])| {
                (*y0 > y) != (*y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
            })
            .count()
    };
    rings.iter().map(crossings).sum::<usize>() % 2 == 1
}
