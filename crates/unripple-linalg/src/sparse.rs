//! Sparse symmetric matrices: fill-reducing ordering and supernodal LDLᵀ factors.

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

/// Why a sparse matrix could not be factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfactored {
    /// There is not enough memory.
    Memory,
    /// A pivot is zero.
    Pivot,
}

/// Symbolic analysis of symmetric n x n matrices with a given pattern of nonzeros in the lower triangle: an ordering by approximate minimum
/// degree, and the structure of supernodal factors. `None` if there is not enough memory.
pub fn analyse(pattern: SymbolicSparseColMatRef<'_, usize>) -> Option<SymbolicCholesky<usize>> {
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, params).ok()
}

/// Numeric factorisation A = L D Lᵀ of a symmetric n x n matrix: returns the values of L and D in the
/// layout of `structure`. `lower` is the lower triangle of A, permuted to the order of `structure`. There
/// is no pivoting, so that by Sylvester's law of inertia D has as many negative entries as A has negative
/// eigenvalues.
///
/// # Errors
/// [`Unfactored`] if a pivot is zero or memory does not suffice.
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
