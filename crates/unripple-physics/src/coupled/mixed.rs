//! Mode shapes as linear combinations of other mode shapes.

use std::sync::Arc;
use unripple_core::{Mixture, Point, Shapes};
use unripple_linalg::{Mat, product};

/// Mode shapes that are linear combinations of other shapes.
#[derive(Debug)]
pub(super) struct Mixed {
    /// The shapes that are combined.
    pub base: Arc<dyn Shapes>,
    /// Coefficients of the combinations, base shapes x columns.
    pub mixing: Mat<f64>,
    /// The column of each shape; several shapes may share one.
    pub columns: Vec<usize>,
}

impl Shapes for Mixed {
    fn modes(&self) -> usize {
        self.columns.len()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let mut base = vec![0.0; self.base.modes()];
        self.base.at(point, &mut base);
        let mixed: Vec<f64> = (0..self.mixing.ncols())
            .map(|c| base.iter().zip(self.mixing.col_as_slice(c)).map(|(b, m)| b * m).sum())
            .collect();
        row.iter_mut().zip(&self.columns).for_each(|(to, column)| *to = mixed[*column]);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let mixed = product(self.base.at_all(points).as_ref(), self.mixing.as_ref());
        Mat::from_fn(points.len(), self.columns.len(), |p, m| mixed[(p, self.columns[m])])
    }

    fn mixture(&self) -> Option<Mixture<'_>> {
        Some(Mixture { base: self.base.as_ref(), mixing: self.mixing.as_ref(), columns: &self.columns })
    }
}
