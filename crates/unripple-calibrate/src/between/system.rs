//! Cholesky factor of the covariance matrix of measured points.

use super::medium::{SpectralLine, Waves};
use unripple_core::Point;
use unripple_linalg::{CholeskyInPlace, Mat, MatMut};

/// Distances between points, the lower triangle row by row, the diagonal left out.
pub(crate) fn distances(points: &[Point]) -> Vec<f64> {
    points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(|q| p.distance(*q))).collect()
}

/// Matrix with `value` of each distance between `points` points below its diagonal, and 0 elsewhere;
/// `distances` come from [`distances`].
pub(crate) fn lower_triangle(distances: &[f64], points: usize, value: impl Fn(f64) -> f64) -> Mat<f64> {
    let mut lower = Mat::zeros(points, points);
    let mut from = distances.iter();
    for i in 0..points {
        for j in 0..i {
            lower[(i, j)] = from.next().map_or(0.0, |distance| value(*distance));
        }
    }
    lower
}

/// Cholesky factor of the covariance matrix of the responses at the points, errors included: K + N = L Lᵀ.
#[derive(Debug)]
pub(crate) struct System {
    covariance: CholeskyInPlace,
}

impl System {
    /// Computes the Cholesky factor for `points` points with these mutual distances (m, lower triangle row
    /// by row); `None` if the matrix is singular.
    pub fn factor(waves: &Waves, line: &SpectralLine, distances: &[f64], points: usize) -> Option<Self> {
        let mut lower = lower_triangle(distances, points, |distance| waves.covariance(line, distance));
        (0..points).for_each(|i| lower[(i, i)] = 1.0 + line.error);
        CholeskyInPlace::new(lower).map(|covariance| Self { covariance })
    }

    /// Solves (K + N) x = b for each column b of `columns`, in place.
    pub fn solve(&self, columns: MatMut<'_, f64>) {
        self.covariance.solve(columns);
    }
}
