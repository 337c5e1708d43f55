//! Mode shapes evaluated anywhere on a mesh.

use super::space::Space;
use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;
use unripple_core::{Point, Shapes};
use unripple_linalg::{Mat, MatRef, row_chunks};

/// Number of modes summed at once: two cache lines of a row of coefficients. With twice this value, more zeros are added to fill the
/// last lanes.
const LANES: usize = 16;

/// Number of points whose shapes one thread computes at a time. With twice this value, there are half as many tasks to share
/// among threads.
const POINTS: usize = 64;

/// Mode shapes as combinations of a space's unknowns, in 1/√kg.
#[derive(Clone)]
pub(crate) struct MeshShapes {
    space: Space,
    modes: usize,
    /// Number of groups of [`LANES`] modes.
    groups: usize,
    /// Coefficients of the modes for each unknown, in groups of [`LANES`] modes.
    lanes: Vec<[f64; LANES]>,
    /// The SIMD instruction set of the processor.
    arch: Arch,
}

impl std::fmt::Debug for MeshShapes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MeshShapes")
            .field("modes", &self.modes)
            .field("unknowns", &self.space.unknowns())
            .finish_non_exhaustive()
    }
}

impl MeshShapes {
    /// Mode shapes from their coefficients, unknowns x modes, which must be mass-normalised and have their
    /// final signs.
    pub(crate) fn new(space: Space, coefficients: MatRef<f64>) -> Self {
        let (unknowns, modes) = (space.unknowns().min(coefficients.nrows()), coefficients.ncols());
        let groups = modes.div_ceil(LANES);
        let mut lanes = vec![[0.0; LANES]; space.unknowns() * groups];
        for m in 0..modes {
            for u in 0..unknowns {
                lanes[u * groups + m / LANES][m % LANES] = coefficients[(u, m)];
            }
        }
        Self { space, modes, groups, lanes, arch: Arch::new() }
    }

    /// Sums the unknowns' values times `weights` for every mode.
    fn sum(&self, unknowns: &[usize], weights: &[f64], row: &mut [f64]) {
        self.arch.dispatch(Sum { lanes: &self.lanes, groups: self.groups, unknowns, weights, row });
    }

    #[cfg(test)]
    /// Shapes and their derivatives at a point: six rows of modes, u, u_x, u_y, u_xx, u_xy and u_yy.
    pub(crate) fn jets_at(&self, point: Point) -> [Vec<f64>; 6] {
        let (unknowns, jets) = self.space.derivatives(point);
        jets.map(|weights| {
            let mut row = vec![0.0; self.modes];
            self.sum(unknowns, &weights, &mut row);
            row
        })
    }
}

impl Shapes for MeshShapes {
    fn modes(&self) -> usize {
        self.modes
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let (unknowns, weights) = self.space.weights(point);
        self.sum(unknowns, &weights, row);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let mut weights = Mat::zeros(points.len(), self.modes);
        let fill = |(points, mut weights): (&[Point], unripple_linalg::MatMut<f64>)| {
            let mut rows = vec![0.0; points.len() * self.modes];
            for (point, row) in points.iter().zip(rows.chunks_exact_mut(self.modes.max(1))) {
                self.at(*point, row);
            }
            for (m, column) in weights.as_mut().col_iter_mut().enumerate() {
                let values = rows[m..].iter().step_by(self.modes);
                if let Some(column) = column.try_as_col_major_mut() {
                    column.as_slice_mut().iter_mut().zip(values).for_each(|(w, v)| *w = *v);
                }
            }
        };
        points.par_chunks(POINTS).zip(row_chunks(weights.as_mut(), POINTS)).for_each(fill);
        weights
    }
}

/// Computes weighted sums of the rows of unknowns.
struct Sum<'a> {
    lanes: &'a [[f64; LANES]],
    groups: usize,
    unknowns: &'a [usize],
    weights: &'a [f64],
    row: &'a mut [f64],
}

impl NullaryFnOnce for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (group, row) in self.row.chunks_mut(LANES).enumerate() {
            let mut sums = [0.0; LANES];
            for (unknown, weight) in self.unknowns.iter().zip(self.weights) {
                let lanes = &self.lanes[unknown * self.groups + group];
                sums.iter_mut().zip(lanes).for_each(|(sum, lane)| *sum += weight * lane);
            }
            row.copy_from_slice(&sums[..row.len()]);
        }
    }
}
