//! Modes of any sheet: quintic elements on a mesh, refined until they no longer change.

mod sizing;

use super::bounds::Bounds;
use super::{Found, GIB, MEMORY};
use crate::PhysicsError;
use crate::elements::{MeshShapes, Space};
use crate::fabric::Fabric;
use crate::mesh::Mesh;
use crate::spectrum::{self, Pairs};
use sizing::Plan;
use unripple_core::Surface;
use unripple_linalg::{ColRef, Mat, sparse_times};

/// How often the mesh may be refined: each time by 1.25 to 2, so that the last is up to 32 times finer than
/// the first. More would change nothing but how late an accuracy out of reach is given up.
const ROUNDS: usize = 6;

/// A mesh is compared with one this many times coarser: so the second solution costs about half of the first.
/// Nearer to 1, the difference that tells the error drowns in rounding.
const COARSER: f64 = 1.3;

/// The share of the error before that a refinement must fall below to count as progress: of edges 1.25 times
/// shorter, sixth order leaves 0.26. At 1, rounding is refined until rounds are over.
const STALLED: f64 = 0.8;

/// Largest residual of an eigenpair; its eigenvalue's relative error is about the square of it, 1e-10. Ten
/// times more would let errors of 1e-8 pass.
const RESIDUAL: f64 = 1e-5;

/// The order that errors of frequencies are taken to fall with, in the edge length; on straight sides they do so with the
/// eighth, on curved ones and at graded corners more slowly.
const ORDER: i32 = 6;

/// Modes of a surface's sheet below the top of `bounds`.
pub(super) fn solve(surface: &Surface, bounds: &Bounds) -> Result<Found, PhysicsError> {
    let fabric = Fabric::of(surface)?;
    let mut plan = Plan::new(surface, &fabric, bounds)?;
    let mut coarse = modes(surface, &fabric, bounds, &plan.coarser(COARSER))?;
    let (mut error, mut last) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..ROUNDS {
        let fine = modes(surface, &fabric, bounds, &plan)?;
        let ratio = if plan.ratio() > 1.0 { plan.ratio() } else { COARSER };
        error = change(&coarse.pairs.values, &fine.pairs.values) / (ratio.powi(ORDER) - 1.0);
        if error <= bounds.accuracy {
            return Ok(found(fine, bounds, error));
        }
        // Rounding, or a corner that is not worth its triangles.
        if error > STALLED * last {
            break;
        }
        last = error;
        coarse = fine;
        plan = plan.refined(error, bounds.accuracy);
    }
    Err(PhysicsError::NotConverged { max_hz: bounds.max_hz, expected: bounds.accuracy, found: error })
}

/// A solution on one mesh.
struct Solution {
    space: Space,
    pairs: Pairs,
    /// Bending's share of each mode's elastic energy.
    bending_shares: Vec<f64>,
}

/// Meshes a sheet as planned, assembles its forms and solves for the modes below the top.
fn modes(surface: &Surface, fabric: &Fabric, bounds: &Bounds, plan: &Plan) -> Result<Solution, PhysicsError> {
    guard(surface, bounds, plan)?;
    let mesh = Mesh::new(&surface.outline, &plan.sizing())?;
    let space = Space::new(&mesh, fabric.bends());
    let forms = space.assemble(fabric);
    let pairs = spectrum::below(forms.stiffness.as_ref(), forms.mass.as_ref(), bounds.top_square())
        .map_err(|error| PhysicsError::Solver { max_hz: bounds.max_hz, found: error.to_string() })?;
    if pairs.residual > RESIDUAL {
        let found = format!("residuals of up to {:e}", pairs.residual);
        return Err(PhysicsError::Solver { max_hz: bounds.max_hz, found });
    }
    let pairs = settled(pairs, bounds);
    let bent = sparse_times(forms.bending.as_ref(), pairs.vectors.as_ref());
    let share = |m: usize| {
        let energy: f64 = bent.col(m).iter().zip(pairs.vectors.col(m).iter()).map(|(b, x)| b * x).sum();
        let square = pairs.values[m];
        if square > 0.0 { (energy / square).clamp(0.0, 1.0) } else { 0.0 }
    };
    let bending_shares = (0..pairs.values.len()).map(share).collect();
    Ok(Solution { space, pairs, bending_shares })
}

/// Modes that move without strain told from rounding: frequencies a thousandth of what the first of so many would have
/// on a plate are 0.
fn settled(mut pairs: Pairs, bounds: &Bounds) -> Pairs {
    let first = bounds.top_square() / (pairs.values.len().max(1) as f64).powi(2);
    pairs.values.iter_mut().filter(|square| **square < 1e-6 * first).for_each(|square| *square = 0.0);
    pairs
}

/// The largest relative difference of two lists of frequencies, given as squares, as far as both go; infinite
/// if one has over a tenth and two more.
fn change(coarse: &[f64], fine: &[f64]) -> f64 {
    let common = coarse.len().min(fine.len());
    if fine.len() as f64 > 1.1 * coarse.len() as f64 + 2.0 {
        return f64::INFINITY;
    }
    let differ = |(a, b): (&f64, &f64)| if *b > 0.0 { (0.5 * (a / b - 1.0)).abs() } else { 0.0 };
    coarse[..common].iter().zip(fine).map(differ).fold(0.0, f64::max)
}

/// The modes of a solution, with the air's mass and their sign.
fn found(solution: Solution, bounds: &Bounds, error: f64) -> Found {
    let Solution { space, pairs, bending_shares } = solution;
    let (omegas, factors): (Vec<f64>, Vec<f64>) =
        pairs.values.iter().map(|square| bounds.loaded(square.max(0.0))).unzip();
    let signed = |m: usize| factors[m] * sign(pairs.vectors.col(m));
    let factors: Vec<f64> = (0..omegas.len()).map(signed).collect();
    let vectors = &pairs.vectors;
    let coefficients = Mat::from_fn(vectors.nrows(), vectors.ncols(), |u, m| vectors[(u, m)] * factors[m]);
    let shapes = Box::new(MeshShapes::new(space, coefficients.as_ref()));
    Found { omegas, bending_shares, shapes, error }
}

/// The sign that makes positive the first coefficient that is at least half the largest.
fn sign(coefficients: ColRef<'_, f64>) -> f64 {
    let largest = coefficients.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    coefficients.iter().find(|c| c.abs() >= 0.5 * largest).map_or(1.0, |c| c.signum())
}

/// Refuses what would not fit in memory, before any of it is taken.
fn guard(surface: &Surface, bounds: &Bounds, plan: &Plan) -> Result<(), PhysicsError> {
    let cost = |plan: &Plan| {
        let unknowns = plan.unknowns(&surface.outline)?;
        Ok::<_, PhysicsError>((unknowns, spectrum::estimate_bytes(unknowns, plan.modes())))
    };
    let (unknowns, needed) = cost(plan)?;
    if needed <= MEMORY {
        return Ok(());
    }
    let (mut fits, mut fails) = (0.0, 1.0);
    for _ in 0..40 {
        let share = 0.5 * (fits + fails);
        if cost(&plan.lower(share))?.1 <= MEMORY { fits = share } else { fails = share }
    }
    Err(PhysicsError::TooLarge {
        max_hz: bounds.max_hz,
        unknowns,
        needed_gib: needed / GIB,
        limit_gib: MEMORY / GIB,
        nearest_hz: bounds.max_hz * fits,
    })
}
