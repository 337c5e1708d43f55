//! Estimates of the memory and time that an eigenvalue problem needs, before any is allocated.

use super::plan::{KEPT, SHARE};

/// Approximate number of entries in each row of the matrices, for quintic elements on a surface. With twice this value, small problems
/// would be estimated twice as large.
const ROW: f64 = 45.0;
/// Number of vectors of a Lanczos basis for 160 eigenpairs, the most that are computed at one shift. With
/// twice this value, problems that fit would be refused.
const BASIS: f64 = 300.0;

/// Processor time of a mode, in seconds, for each entry of the factors: solutions, orthogonalisation and what these share of the factors.
const PER_ENTRY: f64 = 6e-9;

/// Approximate processor time of [`below`](super::below), in seconds.
pub(crate) fn seconds(unknowns: f64, wanted: f64) -> f64 {
    PER_ENTRY * wanted.max(40.0) * fill(unknowns)
}

/// Approximate number of entries of the factors for so many unknowns: that of C1 elements on a surface, some 45 entries in a row:
/// n (20 log₂ n - 125), within 10 % from 2700 to 60 000 unknowns.
fn fill(unknowns: f64) -> f64 {
    unknowns * (20.0 * unknowns.max(2.0).log2() - 125.0).max(ROW)
}

/// Approximate number of bytes that [`below`](super::below) needs for `wanted` eigenpairs of `n` unknowns.
///
/// Each thread holds a factor twice while it is made and one basis; shifts keep
/// their factors up to a quarter of a GiB; all vectors are held twice at the end.
pub(crate) fn estimate_bytes(n: usize, wanted: usize) -> f64 {
    let (unknowns, pairs) = (n as f64, wanted as f64);
    let fill = fill(unknowns);
    let shares = wanted.div_ceil(SHARE);
    let busy = rayon::current_num_threads().min(shares.max(2)) as f64;
    let matrices = unknowns * ROW * 80.0;
    let factors = busy * 16.0 * fill + (8.0 * fill * shares as f64).min(KEPT as f64);
    let bases = busy * 8.0 * unknowns * BASIS;
    matrices + factors + bases + 2.2 * 8.0 * unknowns * pairs
}
