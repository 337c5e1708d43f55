//! What a rectangle's modes cost, in memory and time, before any is computed.

use super::super::ritz::ABOVE;
use super::counts::{FURTHER, first_counts};
use super::problem::Problem;
use super::ritz::LARGE;
use super::separable::Separable;
use crate::PhysicsError;
use crate::spectrum;
use std::f64::consts::PI;
use unripple_core::{Cost, Edge, Memory};

/// Operations of a full decomposition and the estimate of its error, as a multiple of the cube of the number of functions, in products of
/// matrices that take as long.
const DENSE: f64 = 8.0;

/// Seconds of the estimate of the error of a sparse problem, and of its lowest modes combined anew, for each function and mode.
const SPARSE: f64 = 6e-7;

/// Refuses a problem that would not fit in memory, before any is allocated.
pub(super) fn guard(problem: &Problem, counts: [usize; 2]) -> Result<(), PhysicsError> {
    let Size { unknowns, bytes: needed, .. } = size(problem, counts, problem.bounds.k_top);
    let memory = Memory::here();
    if memory.holds(needed) {
        return Ok(());
    }
    let (mut fits, mut fails) = (0.0, problem.bounds.k_top);
    for _ in 0..60 {
        let k = 0.5 * (fits + fails);
        if memory.holds(size(problem, first_counts(problem, k), k).bytes) { fits = k } else { fails = k }
    }
    let nearest_hz = problem.bounds.medium.omega(fits) / (2.0 * PI);
    Err(PhysicsError::too_large(problem.bounds.max_hz, unknowns, needed, nearest_hz))
}

/// Whether a problem fits in the usual memory, whatever this machine has.
pub(super) fn is_usual(problem: &Problem, counts: [usize; 2]) -> bool {
    Memory::default().holds(size(problem, counts, problem.bounds.k_top).bytes)
}

/// What a problem takes in its symmetry classes.
struct Size {
    /// Number of unknowns of the largest class.
    unknowns: usize,
    /// Number of classes, and of modes in each.
    classes: f64,
    modes: f64,
    /// Number of unknowns of a class with the further functions by which the error is estimated.
    all: f64,
    /// Memory in bytes: what each class takes while it is solved, and all mode shapes, twice.
    bytes: f64,
}

/// The size of a problem with the numbers `counts` of functions along its sides; `k` is the wavenumber at the top, in rad/m.
fn size(problem: &Problem, counts: [usize; 2], k: f64) -> Size {
    let class = |axis: usize| {
        let [low, high] = problem.edges[axis];
        match (low == high, low) {
            (true, Edge::Supported) => (1, counts[axis]),
            (true, _) => (counts[axis].div_ceil(2), 2),
            (false, _) => (counts[axis], 1),
        }
    };
    let ((x, nx), (y, ny)) = (class(0), class(1));
    let halved = problem.square() && nx == 1;
    let unknowns = x.saturating_mul(y).div_ceil(1 + usize::from(halved));
    let blocks = nx * ny * (1 + usize::from(halved));
    let at_once = rayon::current_num_threads().min(blocks) as f64;
    let (n, modes) = (unknowns as f64, modes_of_class(problem.sides, k, blocks).min(unknowns as f64));
    // With the further functions: vectors, their products with K and M, and what K - σM makes of these.
    let all = n * (1.0 + 1.0 / FURTHER as f64).powi(2);
    let each = match unknowns < LARGE {
        // Six square matrices.
        true => 48.0 * n * n,
        false => spectrum::estimate_bytes(all as usize, modes as usize) + 48.0 * all * modes,
    };
    let bytes = each * at_once + 16.0 * n * modes * blocks as f64;
    Size { unknowns, classes: blocks as f64, modes, all, bytes }
}

/// The cost of a solution, in as many rounds as most problems take.
///
/// # Errors
/// [`PhysicsError::TooLarge`] if it does not fit in memory.
pub(crate) fn cost(problem: &Problem) -> Result<Cost, PhysicsError> {
    if problem.separable() {
        Separable::guard(problem)?;
        return Ok(Cost::default());
    }
    let counts = first_counts(problem, problem.bounds.k_top);
    guard(problem, counts)?;
    let size = size(problem, counts, problem.bounds.k_top);
    // A square has classes that mirror others.
    let solved = if problem.square() { 0.75 * size.classes } else { size.classes };
    let each = match size.unknowns < LARGE {
        true => DENSE * size.all.powi(3) / Cost::RATE,
        false => spectrum::seconds(size.all, size.modes) + SPARSE * size.all * size.modes,
    };
    Ok(Cost { seconds: solved * each, bytes: size.bytes })
}

/// Number of modes with wavenumbers up to `k` (rad/m) and the share above the top that each of `blocks` symmetry classes computes, by
/// Weyl's law for a free rim.
fn modes_of_class([x, y]: [f64; 2], k: f64, blocks: usize) -> f64 {
    // ω² grows as k² on a membrane, more steeply on a plate.
    let k = k * (1.0 + ABOVE).sqrt();
    (k * k * x * y / (4.0 * PI) + k * (x + y) / PI + 4.0) / blocks as f64
}
