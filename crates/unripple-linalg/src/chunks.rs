//! Threads that share work on matrices, and the parts of a matrix that they work on.

use faer::{MatMut, Par};

/// As many threads as there are, for [`multiply()`](crate::multiply()); on WebAssembly, which has none, the present one.
pub fn all_threads() -> Par {
    #[cfg(target_family = "wasm")]
    return Par::Seq;
    #[cfg(not(target_family = "wasm"))]
    Par::rayon(0)
}

/// The rows of an m x n matrix in chunks of `size` rows, the last of what is left, in their order.
///
/// ```
/// use unripple_linalg::{Mat, col_chunks, row_chunks};
///
/// let mut matrix = Mat::<f64>::zeros(5, 3);
/// for (chunk, mut rows) in (1..).zip(row_chunks(matrix.as_mut(), 2)) {
///     rows.fill(f64::from(chunk));
/// }
/// assert_eq!((matrix[(1, 2)], matrix[(2, 0)], matrix[(4, 1)]), (1.0, 2.0, 3.0));
/// let sizes: Vec<usize> = col_chunks(matrix.as_mut(), 2).iter().map(|columns| columns.ncols()).collect();
/// assert_eq!(sizes, [2, 1]);
/// ```
pub fn row_chunks(mut matrix: MatMut<'_, f64>, size: usize) -> Vec<MatMut<'_, f64>> {
    let mut chunks = Vec::with_capacity(matrix.nrows().div_ceil(size.max(1)));
    while matrix.nrows() > 0 {
        let taken = size.clamp(1, matrix.nrows());
        let (chunk, rest) = matrix.split_at_row_mut(taken);
        chunks.push(chunk);
        matrix = rest;
    }
    chunks
}

/// The columns of an m x n matrix in chunks, as [`row_chunks`] has its rows.
pub fn col_chunks(mut matrix: MatMut<'_, f64>, size: usize) -> Vec<MatMut<'_, f64>> {
    let mut chunks = Vec::with_capacity(matrix.ncols().div_ceil(size.max(1)));
    while matrix.ncols() > 0 {
        let taken = size.clamp(1, matrix.ncols());
        let (chunk, rest) = matrix.split_at_col_mut(taken);
        chunks.push(chunk);
        matrix = rest;
    }
    chunks
}
