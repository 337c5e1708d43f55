//! Products and norms of matrices.

use crate::{Number, all_threads};
use faer::linalg::matmul::matmul_with_conj;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::sparse::SparseColMatRef;
use faer::{Accum, Col, ColRef, Conj, Mat, MatMut, MatRef, Par, c64};

/// Computes `factor · left · right`, m x n from m x k and k x n, with the threads that `par` allows. The
/// result replaces `out` or is added to it, as `accum` says.
///
/// With several threads, the last bits of a result with a single row or column depend on their number; see [`product`].
///
/// # Panics
/// If sizes do not match.
pub fn multiply<T: Number>(
    out: MatMut<'_, T>,
    accum: Accum,
    left: MatRef<'_, T>,
    right: MatRef<'_, T>,
    factor: T,
    par: Par,
) {
    T::multiply(out, accum, left, right, factor, par);
}

/// The product of two matrices, m x k and k x n, as an m x n matrix that is equal to the last bit for any
/// number of threads. It is computed by several threads unless it has a single row or column, since faer
/// would split the sums of such a product among threads.
///
/// # Panics
/// If the number of columns of `left` is not that of rows of `right`.
pub fn product<T: Number>(left: MatRef<'_, T>, right: MatRef<'_, T>) -> Mat<T> {
    let mut out = Mat::zeros(left.nrows(), right.ncols());
    T::multiply(
        out.as_mut(),
        Accum::Replace,
        left,
        right,
        T::one_impl(),
        shared(left.nrows(), right.ncols()),
    );
    out
}

/// Threads for a product with `rows` rows and `columns` columns: one if it has a single row or column,
/// since its sums would be split among threads.
fn shared(rows: usize, columns: usize) -> Par {
    if rows.min(columns) > 1 { all_threads() } else { Par::Seq }
}

/// The product of a matrix, m x k, and a column vector of length k, as a vector of length m, on one thread.
///
/// # Panics
/// If the number of columns of `left` is not that of rows of `right`.
pub fn times_column<T: Number>(left: MatRef<'_, T>, right: ColRef<'_, T>) -> Col<T> {
    let mut out = Col::zeros(left.nrows());
    T::multiply(out.as_mut().as_mat_mut(), Accum::Replace, left, right.as_mat(), T::one_impl(), Par::Seq);
    out
}

/// The product Aᴴ B of complex matrices A = `left`, k x m, and B = `right`, k x n, as m x n.
///
/// # Panics
/// If the numbers of rows differ.
pub fn adjoint_times(left: MatRef<'_, c64>, right: MatRef<'_, c64>) -> Mat<c64> {
    conjugated(left.transpose(), Conj::Yes, right, Conj::No)
}

/// The product A Bᴴ of complex matrices A = `left`, m x k, and B = `right`, n x k, as m x n.
///
/// # Panics
/// If the numbers of columns differ.
pub fn times_adjoint(left: MatRef<'_, c64>, right: MatRef<'_, c64>) -> Mat<c64> {
    conjugated(left, Conj::No, right.transpose(), Conj::Yes)
}

fn conjugated(left: MatRef<'_, c64>, one: Conj, right: MatRef<'_, c64>, other: Conj) -> Mat<c64> {
    let mut out = Mat::zeros(left.nrows(), right.ncols());
    let (unit, par) = (c64::new(1.0, 0.0), shared(left.nrows(), right.ncols()));
    matmul_with_conj(out.as_mut(), Accum::Replace, left, one, right, other, unit, par);
    out
}

/// Adds `factor · A Aᵀ`, with A n x k, to the lower triangle of the n x n matrix `out`, on one thread.
///
/// # Panics
/// If `out` is not n x n.
pub fn add_square(out: MatMut<'_, f64>, factor: f64, a: MatRef<'_, f64>) {
    triangular::matmul(
        out,
        BlockStructure::TriangularLower,
        Accum::Add,
        a,
        BlockStructure::Rectangular,
        a.transpose(),
        BlockStructure::Rectangular,
        factor,
        Par::Seq,
    );
}

/// The product of a sparse matrix, m x k, and a dense one, k x n, as m x n.
///
/// # Panics
/// If sizes do not match.
pub fn sparse_times(left: SparseColMatRef<'_, usize, f64>, right: MatRef<'_, f64>) -> Mat<f64> {
    left * right
}

/// The square of the Frobenius norm, Σ|a|² over all entries of an m x n matrix.
pub fn squared_norm(matrix: MatRef<'_, f64>) -> f64 {
    matrix.squared_norm_l2()
}

/// The Frobenius norm, √Σ|a|² over all entries of an m x n matrix.
pub fn norm(matrix: MatRef<'_, f64>) -> f64 {
    matrix.norm_l2()
}
