//! Linear systems with positive definite matrices, by Cholesky factors, and with triangular matrices.

use crate::all_threads;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt;
use faer::linalg::solvers::{DenseSolveCore, Llt};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Mat, MatMut, MatRef, Par, Side};

/// Threads for a solve: several right-hand sides are shared among threads, a single one is solved on one
/// thread, since its sums would be split among threads.
pub(crate) fn shared<T>(right: &MatMut<'_, T>) -> Par {
    if right.ncols() > 1 { all_threads() } else { Par::Seq }
}

/// The Cholesky factor of a positive definite n x n matrix, A = L Lᵀ.
#[derive(Clone, Debug)]
pub struct Cholesky(Llt<f64>);

impl Cholesky {
    /// Factors a symmetric n x n matrix, of which only the lower triangle is read; `None` if it is not positive definite.
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn new(matrix: MatRef<'_, f64>) -> Option<Self> {
        Llt::new(matrix, Side::Lower).ok().map(Self)
    }

    /// The factor L, n x n, with zeros above the diagonal.
    pub fn lower(&self) -> MatRef<'_, f64> {
        self.0.L()
    }

    /// The inverse A⁻¹, n x n, as a full symmetric matrix.
    pub fn inverse(&self) -> Mat<f64> {
        DenseSolveCore::inverse(&self.0)
    }

    /// Solves A X = B: replaces the right-hand sides B, n x k, by the solutions X.
    ///
    /// # Panics
    /// If `right` does not have n rows.
    pub fn solve(&self, right: MatMut<'_, f64>) {
        let par = shared(&right);
        solve_factored(self.lower(), right, par);
    }
}

fn solve_factored(lower: MatRef<'_, f64>, right: MatMut<'_, f64>, par: Par) {
    let needed = llt::solve::solve_in_place_scratch::<f64>(lower.nrows(), right.ncols(), par);
    let mut buffer = MemBuffer::new(needed);
    llt::solve::solve_in_place(lower, right, par, MemStack::new(&mut buffer));
}

/// The Cholesky factor L of a matrix A = L Lᵀ, computed in place and used on one thread: for many small
/// systems that are solved in parallel.
#[derive(Clone, Debug)]
pub struct CholeskyInPlace(Mat<f64>);

impl CholeskyInPlace {
    /// Factors a symmetric n x n matrix, of which only the lower triangle is read; `None` if it is not positive definite.
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn new(mut matrix: Mat<f64>) -> Option<Self> {
        let needed =
            llt::factor::cholesky_in_place_scratch::<f64>(matrix.nrows(), Par::Seq, Default::default());
        let mut buffer = MemBuffer::new(needed);
        let (stack, none) = (MemStack::new(&mut buffer), Default::default());
        llt::factor::cholesky_in_place(matrix.as_mut(), none, Par::Seq, stack, Default::default()).ok()?;
        Some(Self(matrix))
    }

    /// Solves A X = B: replaces the right-hand sides B, n x k, by the solutions X.
    ///
    /// # Panics
    /// If `right` does not have n rows.
    pub fn solve(&self, right: MatMut<'_, f64>) {
        solve_factored(self.0.as_ref(), right, Par::Seq);
    }
}

/// Solves L X = B with a lower triangular n x n matrix: replaces the right-hand sides B, n x k, by the solutions X.
///
/// # Panics
/// If `right` does not have n rows.
pub fn solve_lower(lower: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    let par = shared(&right);
    solve_lower_triangular_in_place(lower, right, par);
}

/// Solves L X = B as [`solve_lower`] does, with right-hand sides n x k, on one thread.
///
/// # Panics
/// If `right` does not have n rows.
pub fn solve_lower_alone(lower: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    solve_lower_triangular_in_place(lower, right, Par::Seq);
}

/// Solves U X = B with an upper triangular n x n matrix, on one thread: replaces the right-hand sides B, n x k, by the solutions X.
///
/// # Panics
/// If `right` does not have n rows.
pub fn solve_upper_alone(upper: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    solve_upper_triangular_in_place(upper, right, Par::Seq);
}
