//! Orders modes by frequency.

use super::ritz::BlockModes;

/// Relative difference of ω² below which frequencies count as equal: above rounding errors, below any
/// difference that an accuracy can resolve. With twice this value, pairs twice as far apart would be
/// ordered by symmetry instead of frequency.
const DOUBLE: f64 = 1e-9;

/// The squared frequencies ω² in ascending order, and the block and column of each mode; modes of equal
/// frequency are ordered by block, then column.
pub(crate) fn ascending(blocks: &[BlockModes]) -> (Vec<f64>, Vec<(usize, usize)>) {
    let mut modes: Vec<(f64, usize, usize)> = blocks
        .iter()
        .enumerate()
        .flat_map(|(b, block)| block.squares.iter().enumerate().map(move |(m, s)| (*s, b, m)))
        .collect();
    modes.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let squares: Vec<f64> = modes.iter().map(|m| m.0).collect();
    for cluster in modes.chunk_by_mut(|a, b| b.0 - a.0 <= DOUBLE * b.0) {
        cluster.sort_by_key(|m| (m.1, m.2));
    }
    (squares, modes.iter().map(|m| (m.1, m.2)).collect())
}
