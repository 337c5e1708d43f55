//! Rayleigh-Ritz basis enlarged until frequencies converge.

use super::cost;
use super::counts::{first_counts, further};
use super::line::Line;
use super::plate::Plate;
use super::problem::Problem;
use super::product::{Product, Symmetry};
use super::ritz::{BlockModes, LARGE, solve_block};
use super::sparse::SparsePlate;
use super::springs::Springs;
use crate::PhysicsError;
use crate::modes::best::Best;
use crate::modes::bounds::Bounds;
use crate::modes::losses;
use rayon::prelude::*;
use unripple_core::{Edge, Encoded, Observed};
use unripple_linalg::{Mat, Par, all_threads};

/// Largest number of rounds, each with up to 1.6 times as many polynomials as the round before. More would
/// only delay the failure if the accuracy cannot be reached.
const ROUNDS: usize = 12;

/// The share of the least error so far that a round must fall below to count as progress. At 1, chance variation of
/// rounding errors would count as progress.
const STALLED: f64 = 0.7;

/// Number of rounds without progress after which the accuracy counts as out of reach. With twice this
/// value, this takes two rounds more.
const PATIENCE: usize = 2;

/// Least step, as a share of the number of polynomials, once the law of the error is known: it flattens from step to step, and each falls
/// a little short. With twice this value, the last round has up to twelve per cent more polynomials than needed.
const LEAST_STEP: f64 = 0.08;

/// Wavenumber of the functions with values at an end where they couple with few others, relative to that at the top frequency: they fade
/// within its inverse. Where it is 2 to 8, rounding errors in vectors stay below 1e-9; at 1 and 16 they are twenty times as large.
const LAYER: f64 = 4.0;

/// Polynomials that resolve a boundary layer of the width √(D/T), as a multiple of the root of the side over that width, since they tell places
/// at its ends apart that are a few N⁻² of the side from each other. With half this value, errors may be larger than estimated.
const RESOLVED: f64 = 2.0;

/// The modes of a rectangle with the requested accuracy.
pub(crate) struct Solution {
    /// The numbers of basis functions along x and y, of which [`lines`] makes the functions.
    pub(crate) counts: [usize; 2],
    /// The modes, by symmetry class; rigid-body modes come first, each in a class of its own.
    pub(crate) blocks: Vec<BlockModes>,
    /// Largest relative error of a frequency, estimated.
    pub(crate) error: f64,
}

impl Encoded for Solution {
    fn encode(&self, to: &mut Vec<u8>) {
        self.counts.encode(to);
        self.blocks.encode(to);
        self.error.encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        Some(Self {
            counts: Encoded::decode(from)?,
            blocks: Encoded::decode(from)?,
            error: f64::decode(from)?,
        })
    }
}

/// Solves with more and more polynomials until the estimated error is at most the requested one.
pub(crate) fn solve(problem: &Problem) -> Result<Solution, PhysicsError> {
    let first = first_counts(problem, problem.bounds.k_top);
    let mut counts = first;
    let mut before: Option<(f64, f64)> = None;
    let mut best = Best::up_to(problem.bounds.most);
    let observed = Observed::here();
    for round in 1..=ROUNDS {
        // What is out of reach is the accuracy, on every machine alike.
        if best.is_any() && !cost::is_usual(problem, counts) && cost::is_usual(problem, first) {
            break;
        }
        cost::guard(problem, counts)?;
        let [x, y] = counts;
        observed.part(|| format!("{x} x {y} functions, round {round} of {ROUNDS} at most"));
        let plate = plate(problem, lines(problem, counts));
        let solved = solve_blocks(problem, &plate, counts, &observed);
        let Some(blocks) = solved else { break };
        let largest = |error: fn(&BlockModes) -> f64| blocks.iter().map(error).fold(0.0, f64::max);
        let rounded = largest(|block| block.rounded);
        let error = slow(problem, counts) * largest(|block| block.error) + rounded;
        if error <= problem.bounds.accuracy {
            return Ok(Solution { counts, blocks, error });
        }
        let used = counts;
        let step = step(problem.bounds.accuracy, counts, error, &mut before);
        for (axis, count) in counts.iter_mut().enumerate() {
            *count += if plate.lines[axis].exact() { 0 } else { step };
        }
        best.take(Solution { counts: used, blocks, error }, error, STALLED);
        // Once rounding errors are most of what is left, more polynomials only cost memory.
        if best.is_stalled(PATIENCE) || 2.0 * rounded > error {
            break;
        }
    }
    let Bounds { max_hz, accuracy: expected, .. } = problem.bounds;
    best.end().map(|(best, _)| best).map_err(|found| PhysicsError::NotConverged { max_hz, expected, found })
}

/// Factor of the estimated error where boundary layers are not resolved. Error then falls in proportion to the number of polynomials at least, so
/// that a quarter more of them take a fifth of it away, and not the half that the estimate counts on.
fn slow(problem: &Problem, counts: [usize; 2]) -> f64 {
    let unresolved = |axis: usize| {
        let needed = |width: f64| RESOLVED * (problem.sides[axis] / width).sqrt();
        let mut layers = problem.edges[axis].iter().filter_map(|edge| problem.bounds.layer(*edge));
        layers.any(|width| (counts[axis] as f64) < needed(width))
    };
    if unresolved(0) || unresolved(1) { 2.5 } else { 1.0 }
}

/// Number of polynomials to add, extrapolated by the power law of the error so far; an even number, so that both parities grow.
fn step(accuracy: f64, counts: [usize; 2], error: f64, before: &mut Option<(f64, f64)>) -> usize {
    let size = counts[0].max(counts[1]) as f64;
    let (power, least) = match before.replace((size, error)) {
        Some((smaller, larger)) if larger.is_finite() && error < larger => {
            ((larger / error).ln() / (size / smaller).ln(), size * LEAST_STEP)
        }
        // Not known yet: a steep power, so that the first step is small.
        _ => (40.0, 0.0),
    };
    let factor = if error.is_finite() { (error / accuracy).powf(1.0 / power) } else { 1.15 };
    let wanted = (size * (factor.min(1.6) - 1.0)).max(least);
    (wanted.max(2.0).ceil() as usize).next_multiple_of(2)
}

/// The orthonormal functions along each side: `counts` and, unless these are exact, further ones from which the error is estimated.
pub(super) fn lines(problem: &Problem, counts: [usize; 2]) -> [Line; 2] {
    [0, 1].map(|axis| {
        let [low, high] = problem.edges[axis];
        Line::new(low, high, all(problem, axis, counts[axis]))
    })
}

/// The plate in functions of the same spaces most of which couple with few others; `orthonormal` are those of [`lines`]. `None` if rounding
/// errors make them dependent.
pub(super) fn sparse(problem: &Problem, counts: [usize; 2], orthonormal: &[Line; 2]) -> Option<SparsePlate> {
    let cubic = |axis: usize| {
        let [low, high] = problem.edges[axis];
        Line::with_cubics(low, high, all(problem, axis, counts[axis]))
    };
    let fading = |axis: usize| {
        let [low, high] = problem.edges[axis];
        let kappa = LAYER * 0.5 * problem.bounds.k_top * problem.sides[axis];
        Line::fading(low, high, [counts[axis], all(problem, axis, counts[axis])], kappa)
    };
    let fading = plate(problem, [fading(0)?, fading(1)?]);
    Some(SparsePlate::new(fading, plate(problem, [cubic(0), cubic(1)]), orthonormal))
}

/// Number of functions along one side with the further ones.
fn all(problem: &Problem, axis: usize, count: usize) -> usize {
    if problem.edges[axis] == [Edge::Supported; 2] { count } else { count + further(count) }
}

/// The plate's energy in terms of the functions along its sides.
pub(super) fn plate(problem: &Problem, lines: [Line; 2]) -> Plate {
    let medium = &problem.bounds.medium;
    let scale = |power: i32, stiffness: f64| {
        problem.sides.map(|side| stiffness / medium.areal_density * (2.0 / side).powi(power))
    };
    let springs = [0, 1].map(|axis| {
        Springs::of(&lines[axis], problem.edges[axis], problem.sides[axis], medium.areal_density)
    });
    Plate {
        lines,
        springs,
        tension: scale(2, medium.tension),
        bending: scale(4, medium.bending_stiffness),
        poisson: problem.bounds.poisson,
        far: problem.bounds.lossy.then(|| losses::far(problem.edges.as_flattened(), true)),
        square: problem.square(),
    }
}

/// The modes of every symmetry class; classes are shared among threads. `None` if the eigenvalue iteration
/// of a class does not converge.
fn solve_blocks(
    problem: &Problem,
    plate: &Plate,
    counts: [usize; 2],
    observed: &Observed,
) -> Option<Vec<BlockModes>> {
    let classes = [0, 1].map(|axis| plate.lines[axis].classes(counts[axis]));
    let symmetries = Symmetry::all(&classes[0], &classes[1], plate.square);
    let top = problem.bounds.top_square();
    let par = if symmetries.len() == 1 { all_threads() } else { Par::Seq };
    let large = |symmetry: Symmetry| symmetry.products().count() >= LARGE;
    let sparse = match symmetries.iter().any(|(symmetry, _)| large(*symmetry)) {
        true => Some(sparse(problem, counts, &plate.lines)?),
        false => None,
    };
    let steps = observed.steps(symmetries.len());
    let block = |(symmetry, _): &(Symmetry, bool)| match &sparse {
        Some(sparse) if large(*symmetry) => {
            // Where eigenpairs are missed, a full decomposition misses none, at the cost of its time.
            sparse.solve_block(*symmetry, top).ok().or_else(|| solve_block(plate, *symmetry, top, par))
        }
        _ => solve_block(plate, *symmetry, top, par),
    };
    let solved: Option<Vec<BlockModes>> =
        symmetries.par_iter().map(block).inspect(|_| steps.take(1.0)).collect();
    let mut blocks = rigid(plate, counts);
    for (block, (_, twice)) in solved?.into_iter().zip(symmetries) {
        let other = twice.then(|| block.mirrored());
        blocks.push(block);
        blocks.extend(other);
    }
    Some(blocks)
}

/// Rigid-body modes, which store no energy; these are exact.
fn rigid(plate: &Plate, counts: [usize; 2]) -> Vec<BlockModes> {
    let lowest = |axis: usize| 0..counts[axis].min(2);
    lowest(0)
        .flat_map(|x| lowest(1).map(move |y| Product { x, y, mirror: 0.0 }))
        .filter(|product| plate.is_rigid(*product))
        .map(|product| BlockModes {
            products: vec![product],
            squares: vec![0.0],
            bending_shares: vec![0.0],
            second: vec![0.0],
            coefficients: Mat::ones(1, 1),
            error: 0.0,
            rounded: 0.0,
        })
        .collect()
}
