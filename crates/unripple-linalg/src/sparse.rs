//! Sparse symmetric matrices: supernodal LDLᵀ factors, and how they are ordered.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::{
    factorize_supernodal_numeric_ldlt, factorize_supernodal_numeric_ldlt_scratch,
};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::{Par, Side};

pub use faer::sparse::linalg::cholesky::supernodal::{SupernodalLdltRef, SymbolicSupernodalCholesky};
pub use faer::sparse::linalg::cholesky::{SymbolicCholesky, SymbolicCholeskyRaw};
pub use faer::sparse::{
    SparseColMat, SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef, Triplet,
};

/// Why a sparse matrix has no factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfactored {
    /// Memory does not hold them.
    Memory,
    /// A pivot is zero.
    Pivot,
}

/// The structure of the factors of symmetric matrices, n x n, with a pattern in the lower triangle, rows and columns ordered by approximate
/// minimum degree and always gathered in supernodes; `None` if memory does not hold it.
pub fn analyse(pattern: SymbolicSparseColMatRef<'_, usize>) -> Option<SymbolicCholesky<usize>> {
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, params).ok()
}

/// The values of L and D in L D Lᵀ = A, given its lower triangle in the order of `structure`, without exchange of rows or columns: by
/// Sylvester's law of inertia D has as many negative entries as A has negative eigenvalues.
///
/// # Errors
/// [`Unfactored`].
pub fn factor_ldlt(
    structure: &SymbolicSupernodalCholesky<usize>,
    lower: SparseColMatRef<'_, usize, f64>,
    par: Par,
) -> Result<Vec<f64>, Unfactored> {
    let mut values = vec![0.0; structure.len_val()];
    let needed = factorize_supernodal_numeric_ldlt_scratch::<usize, f64>(structure, par, Default::default());
    let mut buffer = MemBuffer::try_new(needed).map_err(|_| Unfactored::Memory)?;
    let stack = MemStack::new(&mut buffer);
    let (none, params) = (LdltRegularization::default(), Default::default());
    factorize_supernodal_numeric_ldlt(&mut values, lower, none, structure, par, stack, params)
        .map_err(|_| Unfactored::Pivot)?;
    Ok(values)
}
