//! Linear systems with general square matrices, by LU factors.

use crate::Entry;
use crate::cholesky::shared;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting;
use faer::linalg::solvers::PartialPivLu;
use faer::traits::ComplexField;
use faer::{Mat, MatMut, MatRef};

/// The LU factors of an n x n matrix A, with partial pivoting (rows are exchanged).
#[derive(Clone, Debug)]
pub struct Lu<T>(PartialPivLu<T>);

impl<T: Entry> Lu<T> {
    /// Factors an n x n matrix. If it is singular, solutions and inverse are not finite.
    pub fn new(matrix: MatRef<'_, T>) -> Self {
        Self(T::lu(matrix))
    }

    /// The inverse A⁻¹, n x n.
    pub fn inverse(&self) -> Mat<T> {
        T::inverse(&self.0)
    }

    /// Solves A X = B: replaces the right-hand sides B, n x k, by the solutions X.
    ///
    /// # Panics
    /// If `right` does not have n rows.
    pub fn solve(&self, right: MatMut<'_, T>) {
        T::solve_lu(&self.0, right);
    }
}

/// The implementation of [`Lu::solve`].
pub(crate) fn solve<T: ComplexField>(factors: &PartialPivLu<T>, right: MatMut<'_, T>) {
    let par = shared(&right);
    let (rows, columns) = right.shape();
    let needed = partial_pivoting::solve::solve_in_place_scratch::<usize, T>(rows, columns, par);
    let mut buffer = MemBuffer::new(needed);
    let (lower, upper, order) = (factors.L(), factors.U(), factors.P());
    partial_pivoting::solve::solve_in_place(lower, upper, order, right, par, MemStack::new(&mut buffer));
}
