//! Modes of any sheet by quintic finite elements on a mesh, refined until frequencies no longer change.

mod sizing;

use super::bounds::Bounds;
use super::found::Found;
use super::memory::{GIB, MEMORY};
use crate::PhysicsError;
use crate::elements::{MeshShapes, Space};
use crate::fabric::Fabric;
use crate::mesh::Mesh;
use crate::spectrum::{self, Pairs};
use sizing::Plan;
use unripple_core::{Observed, Surface};
use unripple_linalg::{ColRef, Mat, sparse_times};

/// Largest number of meshes solved, each finer than the one before by 1.25 to 2, so that the last is up to 32 times finer than
/// the first. More would only delay the failure if the accuracy is out of reach.
const ROUNDS: usize = 6;

/// Ratio of edge lengths of the first two meshes that are compared: the coarser one costs about half as much as the finer.
/// Nearer to 1, their difference, from which the error is estimated, is lost in rounding.
const COARSER: f64 = 1.3;

/// The share of the previous error that a refinement must fall below to count as progress: with edges 1.25 times
/// shorter, sixth order leaves 0.26. At 1, refinement goes on when only rounding errors are left.
const STALLED: f64 = 0.8;

/// Largest residual of an eigenpair; the relative error of its eigenvalue is about its square, 1e-10. Ten
/// times more would allow errors of 1e-8.
const RESIDUAL: f64 = 1e-5;

/// Order of convergence in the edge length that is assumed to estimate the errors of frequencies; on straight sides it is
/// eight, on curved ones and at graded corners less.
const ORDER: i32 = 6;

/// Modes of a surface's sheet below the top of `bounds`.
pub(super) fn solve(surface: &Surface, bounds: &Bounds) -> Result<Found, PhysicsError> {
    let fabric = Fabric::of(surface)?;
    let mut plan = Plan::new(surface, &fabric, bounds)?;
    let mesh = |number: usize| Observed::here().within(format!("mesh {number} of {} at most", 1 + ROUNDS));
    let mut coarse = modes(surface, &fabric, bounds, &plan.coarser(COARSER), &mesh(1))?;
    let (mut error, mut last) = (f64::INFINITY, f64::INFINITY);
    for round in 0..ROUNDS {
        let fine = modes(surface, &fabric, bounds, &plan, &mesh(2 + round))?;
        let ratio = if plan.ratio() > 1.0 { plan.ratio() } else { COARSER };
        error = change(&coarse.pairs.values, &fine.pairs.values) / (ratio.powi(ORDER) - 1.0);
        if error <= bounds.accuracy {
            return Ok(found(fine, bounds, error));
        }
        // The rest is rounding, or a corner that would need too many triangles.
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

/// Meshes a sheet as planned, assembles its matrices and solves for the modes below the top.
fn modes(
    surface: &Surface,
    fabric: &Fabric,
    bounds: &Bounds,
    plan: &Plan,
    observed: &Observed,
) -> Result<Solution, PhysicsError> {
    guard(surface, bounds, plan)?;
    observed.part(|| "triangles".into());
    let mesh = Mesh::new(&surface.outline, &plan.sizing())?;
    let space = Space::new(&mesh, fabric.bends()).with_kinks(&mesh, fabric);
    observed.part(|| "matrices".into());
    let forms = space.assemble(fabric);
    let observed = observed.within(format!("{} unknowns", forms.mass.nrows()));
    let pairs =
        spectrum::below(forms.stiffness.as_ref(), forms.mass.as_ref(), bounds.top_square(), &observed)
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

/// Sets the eigenvalues of rigid-body modes, which are not 0 by rounding, to 0: frequencies below a thousandth of that
/// expected of the first mode of a plate with as many modes.
fn settled(mut pairs: Pairs, bounds: &Bounds) -> Pairs {
    let first = bounds.top_square() / (pairs.values.len().max(1) as f64).powi(2);
    pairs.values.iter_mut().filter(|square| **square < 1e-6 * first).for_each(|square| *square = 0.0);
    pairs
}

/// The largest relative difference of two lists of frequencies, given as squares, up to the end of the shorter; infinite
/// if the finer mesh has over a tenth and two more.
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

/// Refuses a problem that would not fit in memory, before any is allocated.
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
