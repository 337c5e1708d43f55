//! Cholesky factor of the covariance matrix of measured points.

use super::medium::{SpectralLine, Waves};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::{factor, solve};
use faer::{Mat, MatMut, MatRef, Par};
use unripple_core::Point;

/// Distances between points, the lower triangle row by row, the diagonal left out.
pub(crate) fn distances(points: &[Point]) -> Vec<f64> {
    points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(|q| p.distance(*q))).collect()
}

/// The factor of the covariance of what is measured at points, errors included: K + N = L Lᵀ.
#[derive(Debug)]
pub(crate) struct System {
    lower: Mat<f64>,
}

impl System {
    /// `None` if it is singular.
    pub fn factor(waves: &Waves, line: &SpectralLine, distances: &[f64], points: usize) -> Option<Self> {
        let mut lower = Mat::zeros(points, points);
        let mut from = distances.iter();
        for i in 0..points {
            for j in 0..i {
                lower[(i, j)] = from.next().map_or(0.0, |distance| waves.covariance(line, *distance));
            }
            lower[(i, i)] = 1.0 + line.error;
        }
        let scratch = factor::cholesky_in_place_scratch::<f64>(points, Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        factor::cholesky_in_place(lower.as_mut(), Default::default(), Par::Seq, stack, Default::default())
            .ok()?;
        Some(Self { lower })
    }

    /// (K + N)⁻¹ times columns, in place.
    pub fn solve(&self, columns: MatMut<'_, f64>) {
        let scratch = solve::solve_in_place_scratch::<f64>(self.lower.nrows(), columns.ncols(), Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        solve::solve_in_place(self.lower.as_ref(), columns, Par::Seq, MemStack::new(&mut memory));
    }

    /// kᵀ (K + N)⁻¹ k.
    pub fn explained(&self, row: &[f64]) -> f64 {
        let mut column = Mat::from_fn(row.len(), 1, |i, _| row[i]);
        self.solve(column.as_mut());
        (MatRef::from_row_major_slice(row, 1, row.len()) * column)[(0, 0)]
    }
}
