//! Rayleigh-Ritz basis enlarged until frequencies converge.

use super::line::Line;
use super::plate::Plate;
use super::problem::Problem;
use super::product::{Product, Symmetry};
use super::ritz::{BlockModes, solve_block};
use super::springs::Springs;
use crate::PhysicsError;
use crate::modes::best::Best;
use crate::modes::bounds::Bounds;
use crate::modes::memory::{GIB, MEMORY};
use rayon::prelude::*;
use std::f64::consts::PI;
use unripple_core::{Edge, Observed};
use unripple_linalg::{Mat, Par};

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

/// The modes of a rectangle with the requested accuracy.
pub(crate) struct Solution {
    /// The basis functions along x and y.
    pub(crate) lines: [Line; 2],
    /// The modes, by symmetry class; rigid-body modes come first, each in a class of its own.
    pub(crate) blocks: Vec<BlockModes>,
    /// Largest relative error of a frequency, estimated.
    pub(crate) error: f64,
}

/// Solves with more and more polynomials until the estimated error is at most the requested one.
pub(crate) fn solve(problem: &Problem) -> Result<Solution, PhysicsError> {
    let mut counts = first_counts(problem, problem.bounds.k_top);
    let mut before: Option<(f64, f64)> = None;
    let mut best = Best::up_to(problem.bounds.most);
    let observed = Observed::here();
    for round in 1..=ROUNDS {
        match guard(problem, counts) {
            // What is out of reach is the accuracy.
            Err(PhysicsError::TooLarge { .. }) if best.is_any() => break,
            guarded => guarded?,
        }
        let [x, y] = counts;
        observed.part(|| format!("{x} x {y} functions, round {round} of {ROUNDS} at most"));
        let plate = plate(problem, counts);
        let solved = solve_blocks(&plate, counts, problem.bounds.top_square(), &observed);
        let Some(blocks) = solved else { break };
        let lowest = blocks.iter().flat_map(|b| &b.squares).copied().filter(|square| *square > 0.0);
        let rounded = plate.rounded(lowest.fold(f64::INFINITY, f64::min));
        let error = blocks.iter().map(|b| b.error).fold(0.0, f64::max) + rounded;
        if error <= problem.bounds.accuracy {
            return Ok(Solution { blocks, error, lines: plate.lines });
        }
        let step = step(problem.bounds.accuracy, counts, error, &mut before);
        for (axis, count) in counts.iter_mut().enumerate() {
            *count += if plate.lines[axis].exact() { 0 } else { step };
        }
        best.take(Solution { blocks, error, lines: plate.lines }, error, STALLED);
        // Once rounding errors are most of what is left, more polynomials only cost memory.
        if best.is_stalled(PATIENCE) || 2.0 * rounded > error {
            break;
        }
    }
    let Bounds { max_hz, accuracy: expected, .. } = problem.bounds;
    best.end().map(|(best, _)| best).map_err(|found| PhysicsError::NotConverged { max_hz, expected, found })
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

/// Initial number of functions along each side, for waves up to the wavenumber `k` (rad/m).
///
/// Sines: all that can have an energy below the top, with the bending stiffness D(1-ν²), the least that a strip can have.
/// Polynomials: about k·side/2 resolve the wave; beyond this number, the error falls by about e^1.5 for each.
fn first_counts(problem: &Problem, k: f64) -> [usize; 2] {
    let mut soft = problem.bounds.vacuum();
    let square = soft.omega(k);
    soft.bending_stiffness *= 1.0 - problem.bounds.poisson * problem.bounds.poisson;
    [0, 1].map(|axis| {
        let side = problem.sides[axis];
        if problem.edges[axis] == [Edge::Supported; 2] {
            return (soft.wavenumber(square) * side / PI) as usize + 1;
        }
        let half = 0.5 * k * side;
        let free = f64::from(u8::from(problem.edges[axis].iter().any(|edge| edge.moves())));
        let margin = 2.5 * free - half.cbrt() - problem.bounds.accuracy.ln() / 1.5;
        ((half + margin).ceil().max(4.0) as usize).next_multiple_of(2)
    })
}

/// Number of basis functions, beyond the first `count`, from which the error is estimated.
fn further(count: usize) -> usize {
    (count / 4).max(4).next_multiple_of(2)
}

/// The plate's energy in terms of `counts` functions along each side, and of the additional functions from
/// which the error is estimated.
fn plate(problem: &Problem, counts: [usize; 2]) -> Plate {
    let line = |axis: usize| {
        let [low, high] = problem.edges[axis];
        let exact = [low, high] == [Edge::Supported; 2];
        Line::new(low, high, counts[axis] + if exact { 0 } else { further(counts[axis]) })
    };
    let medium = &problem.bounds.medium;
    let scale = |power: i32, stiffness: f64| {
        problem.sides.map(|side| stiffness / medium.areal_density * (2.0 / side).powi(power))
    };
    let lines = [line(0), line(1)];
    let springs = [0, 1].map(|axis| {
        Springs::of(&lines[axis], problem.edges[axis], problem.sides[axis], medium.areal_density)
    });
    Plate {
        lines,
        springs,
        tension: scale(2, medium.tension),
        bending: scale(4, medium.bending_stiffness),
        poisson: problem.bounds.poisson,
        square: problem.square(),
    }
}

/// The modes of every symmetry class; classes are shared among threads. `None` if the eigenvalue iteration
/// of a class does not converge.
fn solve_blocks(plate: &Plate, counts: [usize; 2], top: f64, observed: &Observed) -> Option<Vec<BlockModes>> {
    let classes = [0, 1].map(|axis| plate.lines[axis].classes(counts[axis]));
    let symmetries = Symmetry::all(&classes[0], &classes[1], plate.square);
    let par = if symmetries.len() == 1 { Par::rayon(0) } else { Par::Seq };
    let steps = observed.steps(symmetries.len());
    let block = |(symmetry, _): &(_, _)| solve_block(plate, *symmetry, top, par);
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
            coefficients: Mat::ones(1, 1),
            error: 0.0,
        })
        .collect()
}

/// Refuses a problem that would not fit in memory, before any is allocated.
fn guard(problem: &Problem, counts: [usize; 2]) -> Result<(), PhysicsError> {
    let (unknowns, needed) = cost(problem, counts);
    if needed <= MEMORY {
        return Ok(());
    }
    let (mut fits, mut fails) = (0.0, problem.bounds.k_top);
    for _ in 0..60 {
        let k = 0.5 * (fits + fails);
        if cost(problem, first_counts(problem, k)).1 <= MEMORY { fits = k } else { fails = k }
    }
    Err(PhysicsError::TooLarge {
        max_hz: problem.bounds.max_hz,
        unknowns,
        needed_gib: needed / GIB,
        limit_gib: MEMORY / GIB,
        nearest_hz: problem.bounds.medium.omega(fits) / (2.0 * PI),
    })
}

/// Number of unknowns of the largest symmetry class, and memory in bytes for the solution: six matrices for
/// each class being solved, and all mode shapes.
fn cost(problem: &Problem, counts: [usize; 2]) -> (usize, f64) {
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
    (unknowns, 8.0 * (unknowns as f64).powi(2) * (6.0 * at_once + blocks as f64 / 2.0))
}
