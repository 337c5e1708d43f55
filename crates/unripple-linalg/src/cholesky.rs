//! Positive definite systems by Cholesky factors, and triangular ones.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt;
use faer::linalg::solvers::{DenseSolveCore, Llt};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Mat, MatMut, MatRef, Par, Side};

/// How many threads share right-hand sides: a single one would have its sums cut in as many parts.
pub(crate) fn shared<T>(right: &MatMut<'_, T>) -> Par {
    if right.ncols() > 1 { Par::rayon(0) } else { Par::Seq }
}

/// The Cholesky factor of a positive definite n x n matrix, A = L Lᵀ.
#[derive(Clone, Debug)]
pub struct Cholesky(Llt<f64>);

impl Cholesky {
    /// From the lower triangle of a matrix; `None` if it is not positive definite.
    ///
    /// # Panics
    /// If it is not square.
    pub fn new(matrix: MatRef<'_, f64>) -> Option<Self> {
        Llt::new(matrix, Side::Lower).ok().map(Self)
    }

    /// L, n x n, with zeros above the diagonal.
    pub fn lower(&self) -> MatRef<'_, f64> {
        self.0.L()
    }

    /// A⁻¹, n x n, both triangles of it.
    pub fn inverse(&self) -> Mat<f64> {
        DenseSolveCore::inverse(&self.0)
    }

    /// Replaces right-hand sides, n x k, by the solutions of A x = b.
    ///
    /// # Panics
    /// If there are not n rows.
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

/// A Cholesky factor made in place and used on one thread: for many small systems that threads share whole.
#[derive(Clone, Debug)]
pub struct CholeskyInPlace(Mat<f64>);

impl CholeskyInPlace {
    /// From a positive definite n x n matrix, of which the lower triangle is read; `None` if it is not.
    ///
    /// # Panics
    /// If it is not square.
    pub fn new(mut matrix: Mat<f64>) -> Option<Self> {
        let needed =
            llt::factor::cholesky_in_place_scratch::<f64>(matrix.nrows(), Par::Seq, Default::default());
        let mut buffer = MemBuffer::new(needed);
        let (stack, none) = (MemStack::new(&mut buffer), Default::default());
        llt::factor::cholesky_in_place(matrix.as_mut(), none, Par::Seq, stack, Default::default()).ok()?;
        Some(Self(matrix))
    }

    /// Replaces right-hand sides, n x k, by the solutions of A x = b.
    ///
    /// # Panics
    /// If there are not n rows.
    pub fn solve(&self, right: MatMut<'_, f64>) {
        solve_factored(self.0.as_ref(), right, Par::Seq);
    }
}

/// Replaces right-hand sides, n x k, by the solutions of L x = b, L lower triangular.
///
/// # Panics
/// If there are not n rows.
pub fn solve_lower(lower: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    let par = shared(&right);
    solve_lower_triangular_in_place(lower, right, par);
}

/// The same on one thread.
///
/// # Panics
/// If there are not n rows.
pub fn solve_lower_alone(lower: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    solve_lower_triangular_in_place(lower, right, Par::Seq);
}

/// Replaces right-hand sides, n x k, by the solutions of U x = b, U upper triangular, on one thread.
///
/// # Panics
/// If there are not n rows.
pub fn solve_upper_alone(upper: MatRef<'_, f64>, right: MatMut<'_, f64>) {
    solve_upper_triangular_in_place(upper, right, Par::Seq);
}
