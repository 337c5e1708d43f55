//! Systems of any kind by LU factors.

use crate::Entry;
use crate::cholesky::shared;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting;
use faer::linalg::solvers::PartialPivLu;
use faer::traits::ComplexField;
use faer::{Mat, MatMut, MatRef};

/// The LU factors of an n x n matrix, rows exchanged for the largest pivots.
#[derive(Clone, Debug)]
pub struct Lu<T>(PartialPivLu<T>);

impl<T: Entry> Lu<T> {
    /// Of a matrix, which solves nothing finite if it is singular.
    pub fn new(matrix: MatRef<'_, T>) -> Self {
        Self(T::lu(matrix))
    }

    /// The inverse, n x n.
    pub fn inverse(&self) -> Mat<T> {
        T::inverse(&self.0)
    }

    /// Replaces right-hand sides, n x k, by the solutions of A x = b.
    ///
    /// # Panics
    /// If there are not n rows.
    pub fn solve(&self, right: MatMut<'_, T>) {
        T::solve_lu(&self.0, right);
    }
}

/// What [`Lu::solve`] does.
pub(crate) fn solve<T: ComplexField>(factors: &PartialPivLu<T>, right: MatMut<'_, T>) {
    let par = shared(&right);
    let (rows, columns) = right.shape();
    let needed = partial_pivoting::solve::solve_in_place_scratch::<usize, T>(rows, columns, par);
    let mut buffer = MemBuffer::new(needed);
    let (lower, upper, order) = (factors.L(), factors.U(), factors.P());
    partial_pivoting::solve::solve_in_place(lower, upper, order, right, par, MemStack::new(&mut buffer));
}
