//! Memory that an eigenvalue problem will take, estimated before any is taken.

use super::plan::{KEPT, SHARE};

/// Entries of the matrices in each row, about: those of quintic elements on a surface. Doubled, small problems
/// would be taken for twice as large.
const ROW: f64 = 45.0;
/// Vectors of a basis for a whole share of eigenpairs: 160 and what the iteration takes beyond. Doubled,
/// problems would be refused that fit.
const BASIS: f64 = 300.0;

/// Bytes that [`below`](super::below) takes for `wanted` eigenpairs of `n` unknowns, roughly.
///
/// The fill of the factors is that of C1 elements on a surface, some 45 entries in a row: n (20 log₂ n - 125) entries,
/// within 10 % from 2700 to 60 000 unknowns. Each thread holds a factor twice while it is made and one basis; shifts keep
/// their factors up to a quarter of a GiB; all vectors are held twice at the end.
pub(crate) fn estimate_bytes(n: usize, wanted: usize) -> f64 {
    let (unknowns, pairs) = (n as f64, wanted as f64);
    let fill = unknowns * (20.0 * unknowns.max(2.0).log2() - 125.0).max(ROW);
    let shares = wanted.div_ceil(SHARE);
    let busy = rayon::current_num_threads().min(shares.max(2)) as f64;
    let matrices = unknowns * ROW * 80.0;
    let factors = busy * 16.0 * fill + (8.0 * fill * shares as f64).min(KEPT as f64);
    let bases = busy * 8.0 * unknowns * BASIS;
    matrices + factors + bases + 2.2 * 8.0 * unknowns * pairs
}
