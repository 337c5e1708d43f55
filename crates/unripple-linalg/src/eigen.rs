//! Eigenvalues and eigenvectors of dense matrices.

use crate::{Entry, General};
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{
    ComputeEigenvectors, SelfAdjointEvdParams, evd_cplx, evd_real, evd_scratch, self_adjoint_evd,
    self_adjoint_evd_scratch,
};
use faer::traits::ComplexField;
use faer::{Auto, Mat, MatRef, Par, c64};

/// Eigenvalues (ascending) and orthonormal eigenvectors (the columns of an n x n matrix) of a symmetric or
/// Hermitian n x n matrix, by divide and conquer. Only the lower triangle is read. `None` if the iteration
/// does not converge, as when entries are not finite.
///
/// Eigenvectors may have errors of 1e-5 where eigenvalues differ by orders of magnitude; see [`exact_symmetric`].
pub fn symmetric<T: Entry>(matrix: MatRef<'_, T>) -> Option<(Vec<f64>, Mat<T>)> {
    T::symmetric(matrix)
}

/// Eigenvalues and eigenvectors of a symmetric n x n matrix, returned as by [`symmetric`], by QR iteration.
/// Errors are within machine precision times the largest eigenvalue.
pub fn exact_symmetric(matrix: MatRef<'_, f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let mut params: SelfAdjointEvdParams = Auto::<f64>::auto();
    params.recursion_threshold = usize::MAX;
    decomposed(matrix, params)
}

/// Eigenvalues and eigenvectors by divide and conquer, in the form of [`symmetric`].
pub(crate) fn divided<T: ComplexField<Real = f64>>(matrix: MatRef<'_, T>) -> Option<(Vec<f64>, Mat<T>)> {
    decomposed(matrix, Auto::<T>::auto())
}

fn decomposed<T: ComplexField<Real = f64>>(
    matrix: MatRef<'_, T>,
    params: SelfAdjointEvdParams,
) -> Option<(Vec<f64>, Mat<T>)> {
    let n = matrix.nrows();
    let (mut values, mut vectors) = (Diag::<T>::zeros(n), Mat::zeros(n, n));
    let needed = self_adjoint_evd_scratch::<T>(n, ComputeEigenvectors::Yes, Par::Seq, params.into());
    let mut buffer = MemBuffer::try_new(needed).ok()?;
    let (to, stack) = (Some(vectors.as_mut()), MemStack::new(&mut buffer));
    self_adjoint_evd(matrix, values.as_mut(), to, Par::Seq, stack, params.into()).ok()?;
    Some((values.column_vector().iter().map(T::real_part_impl).collect(), vectors))
}

/// The eigenvalues and right eigenvectors of a general n x n matrix; `None` if the iteration does not converge, as when entries are not
/// finite.
pub fn general<T: Entry>(matrix: MatRef<'_, T>) -> Option<General> {
    T::general(matrix)
}

fn scratch<T: ComplexField>(n: usize) -> Option<MemBuffer> {
    let (left, right) = (ComputeEigenvectors::No, ComputeEigenvectors::Yes);
    MemBuffer::try_new(evd_scratch::<T>(n, left, right, Par::Seq, Default::default())).ok()
}

/// [`general`] of a complex matrix, on one thread.
pub(crate) fn general_complex(matrix: MatRef<'_, c64>) -> Option<General> {
    let n = matrix.nrows();
    let (mut values, mut vectors) = (Diag::<c64>::zeros(n), Mat::zeros(n, n));
    let mut buffer = scratch::<c64>(n)?;
    let stack = MemStack::new(&mut buffer);
    let to = Some(vectors.as_mut());
    evd_cplx(matrix, values.as_mut(), None, to, Par::Seq, stack, Default::default()).ok()?;
    Some(General { values: values.column_vector().iter().copied().collect(), vectors })
}

/// [`general`] of a real matrix, on one thread.
pub(crate) fn general_real(matrix: MatRef<'_, f64>) -> Option<General> {
    let n = matrix.nrows();
    let (mut re, mut im) = (Diag::<f64>::zeros(n), Diag::<f64>::zeros(n));
    let mut real = Mat::zeros(n, n);
    let mut buffer = scratch::<f64>(n)?;
    let (stack, to) = (MemStack::new(&mut buffer), Some(real.as_mut()));
    evd_real(matrix, re.as_mut(), im.as_mut(), None, to, Par::Seq, stack, Default::default()).ok()?;
    let pairs = re.column_vector().iter().zip(im.column_vector().iter());
    let values: Vec<c64> = pairs.map(|(re, im)| c64::new(*re, *im)).collect();
    Some(General { vectors: joined(&values, real.as_ref()), values })
}

/// Complex eigenvectors from the real columns that faer returns. Of a pair of conjugate eigenvalues, the first has the positive imaginary
/// part; the first column of the pair holds the real part of its eigenvector, the second the imaginary part.
fn joined(values: &[c64], real: MatRef<'_, f64>) -> Mat<c64> {
    let n = values.len();
    let mut vectors = Mat::zeros(n, n);
    let at = |i: usize, j: usize| real[(i, j)];
    let mut j = 0;
    while j < n {
        if values[j].im == 0.0 {
            (0..n).for_each(|i| vectors[(i, j)] = c64::new(at(i, j), 0.0));
            j += 1;
            continue;
        }
        for i in 0..n {
            vectors[(i, j)] = c64::new(at(i, j), at(i, j + 1));
            vectors[(i, j + 1)] = c64::new(at(i, j), -at(i, j + 1));
        }
        j += 2;
    }
    vectors
}
