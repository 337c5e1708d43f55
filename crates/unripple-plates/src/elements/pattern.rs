//! Sparsity pattern of the stiffness and mass matrices: pairs of unknowns that share a triangle.

use super::space::Space;
use unripple_linalg::sparse::SymbolicSparseColMat;

/// The symmetric sparsity pattern of all matrices on a space; both triangles are listed, with ascending
/// rows.
pub(crate) fn pattern(space: &Space) -> SymbolicSparseColMat<usize> {
    let size = space.unknowns();
    let mut sharers = vec![Vec::new(); size];
    let among: Vec<Vec<usize>> = space.elements.iter().map(|element| space.relative.among(element)).collect();
    for (e, unknowns) in among.iter().enumerate() {
        unknowns.iter().for_each(|u| sharers[*u].push(e));
    }
    let mut seen = vec![usize::MAX; size];
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for (column, sharers) in sharers.iter().enumerate() {
        let start = rows.len();
        for row in sharers.iter().flat_map(|e| &among[*e]) {
            if seen[*row] != column {
                seen[*row] = column;
                rows.push(*row);
            }
        }
        rows[start..].sort_unstable();
        starts.push(rows.len());
    }
    SymbolicSparseColMat::new_checked(size, size, starts, None, rows)
}
