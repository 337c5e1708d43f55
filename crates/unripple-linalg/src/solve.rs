//! Systems of equations.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt;
use faer::linalg::lu::partial_pivoting;
use faer::linalg::solvers::{Llt, PartialPivLu};
use faer::traits::ComplexField;
use faer::{MatMut, Par};

/// How many threads share right-hand sides: a single one would have its sums cut in as many parts.
fn shared<T>(right: &MatMut<'_, T>) -> Par {
    if right.ncols() > 1 { Par::rayon(0) } else { Par::Seq }
}

/// Replaces right-hand sides, n x k, by the solutions of A x = b, A positive definite and given by its Cholesky factor.
///
/// # Panics
/// If there are not n rows.
pub fn solve_cholesky<T: ComplexField>(factor: &Llt<T>, right: MatMut<'_, T>) {
    let par = shared(&right);
    let needed = llt::solve::solve_in_place_scratch::<T>(factor.L().nrows(), right.ncols(), par);
    let mut buffer = MemBuffer::new(needed);
    llt::solve::solve_in_place(factor.L(), right, par, MemStack::new(&mut buffer));
}

/// Replaces right-hand sides, n x k, by the solutions of A x = b, A given by its LU factors.
///
/// # Panics
/// If there are not n rows.
pub fn solve_lu<T: ComplexField>(factors: &PartialPivLu<T>, right: MatMut<'_, T>) {
    let par = shared(&right);
    let (rows, columns) = right.shape();
    let needed = partial_pivoting::solve::solve_in_place_scratch::<usize, T>(rows, columns, par);
    let mut buffer = MemBuffer::new(needed);
    let (lower, upper, order) = (factors.L(), factors.U(), factors.P());
    partial_pivoting::solve::solve_in_place(lower, upper, order, right, par, MemStack::new(&mut buffer));
}
