//! Products of sparse symmetric matrices with many vectors, a panel at a time.

use super::panel::{LANES, NONE, Row, add};
use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;
use unripple_linalg::sparse::SparseColMatRef;
use unripple_linalg::{Mat, MatRef, col_chunks};

/// The product A X of a symmetric matrix, given with both triangles, and vectors in columns: unknowns x vectors.
pub(crate) fn symmetric_times(matrix: SparseColMatRef<usize, f64>, vectors: MatRef<f64>) -> Mat<f64> {
    let arch = Arch::new();
    let mut out = Mat::zeros(vectors.nrows(), vectors.ncols());
    col_chunks(out.as_mut(), LANES).into_par_iter().enumerate().for_each(|(chunk, columns)| {
        let x = panel(vectors, chunk * LANES);
        let product = times(arch, matrix, &x);
        for (lane, column) in columns.col_iter_mut().enumerate() {
            column.iter_mut().zip(&product).for_each(|(to, row)| *to = row[lane]);
        }
    });
    out
}

/// The work xᵀAx of each vector, for a symmetric matrix given with both triangles.
pub(crate) fn works(matrix: SparseColMatRef<usize, f64>, vectors: MatRef<f64>) -> Vec<f64> {
    let arch = Arch::new();
    let starts: Vec<usize> = (0..vectors.ncols()).step_by(LANES).collect();
    let panels = starts.into_par_iter().map(|first| {
        let x = panel(vectors, first);
        dot(&x, &times(arch, matrix, &x))[..LANES.min(vectors.ncols() - first)].to_vec()
    });
    panels.collect::<Vec<_>>().concat()
}

/// The vectors from `first` on, as many as there are lanes, row by row; zeros where there are no more.
fn panel(vectors: MatRef<f64>, first: usize) -> Vec<Row> {
    let mut rows = vec![NONE; vectors.nrows()];
    for lane in 0..LANES.min(vectors.ncols() - first) {
        rows.iter_mut().zip(vectors.col(first + lane).iter()).for_each(|(row, value)| row[lane] = *value);
    }
    rows
}

fn dot(x: &[Row], y: &[Row]) -> Row {
    let mut sum = NONE;
    for (x, y) in x.iter().zip(y) {
        (0..LANES).for_each(|lane| sum[lane] += x[lane] * y[lane]);
    }
    sum
}

fn times(arch: Arch, matrix: SparseColMatRef<usize, f64>, x: &[Row]) -> Vec<Row> {
    let mut out = vec![NONE; x.len()];
    arch.dispatch(Times { matrix, x, out: &mut out });
    out
}

struct Times<'a> {
    matrix: SparseColMatRef<'a, usize, f64>,
    x: &'a [Row],
    out: &'a mut [Row],
}

impl NullaryFnOnce for Times<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (rows, values) = (self.matrix.row_idx(), self.matrix.val());
        for (out, ends) in self.out.iter_mut().zip(self.matrix.col_ptr().windows(2)) {
            let mut sum = NONE;
            for (i, value) in rows[ends[0]..ends[1]].iter().zip(&values[ends[0]..ends[1]]) {
                add(&mut sum, *value, &self.x[*i]);
            }
            *out = sum;
        }
    }
}
