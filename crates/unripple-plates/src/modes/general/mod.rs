//! Modes of any sheet by quintic finite elements on a mesh, refined until the error of the frequencies is
//! the requested one.

mod meshed;
mod polygon;
mod rates;
mod sizing;
mod solution;

use super::best::Best;
use super::bounds::Bounds;
use super::eigen::sign;
use super::found::{Errors, Found};
use super::losses;
use crate::PhysicsError;
use crate::elements::MeshShapes;
use crate::fabric::Fabric;
use crate::spectrum::{self, Pairs};
use meshed::{mean_edge, meshed};
use sizing::Plan;
use solution::Solution;
use std::f64::consts::TAU;
use unripple_core::{Cached, Cost, Decay, Edge, Encoded, Memory, Observed, Surface};
use unripple_linalg::sparse::SparseColMatRef;
use unripple_linalg::{Mat, product};

/// Largest number of meshes solved after the first two, each finer than the mesh before by a factor of 1.25
/// to 1.6. More would only delay the failure if the accuracy cannot be reached.
const ROUNDS: usize = 6;

/// Planned ratio of edge lengths of the first three meshes: the two coarser meshes cost about a half and a
/// third of the third. Nearer to 1, the differences from which the error is estimated are lost in random
/// differences of unlike meshes; with 1.3, the coarsest has two edges in a wavelength, and differences are
/// too large.
const COARSER: f64 = 1.2;

/// The share of the least error so far that a refinement must fall below to count as progress: with edges 1.25 times
/// shorter, sixth order leaves 0.26. At 1, refinement goes on when only rounding errors are left.
const STALLED: f64 = 0.8;

/// Number of rounds without progress after which the accuracy counts as out of reach: if the rate of
/// convergence was measured too high by chance, the next round looks worse.
const PATIENCE: usize = 2;

/// Factor between one accuracy and the next that is tried if meshes for the first would not fit in the usual memory.
/// With twice this value, the accuracy may be six times worse than memory allows.
const RELAXED: f64 = 3.0;

/// Processor time of meshing and of assembling matrices, in seconds for each unknown.
const MESHING: f64 = 6e-5;

/// Largest residual of an eigenpair; the relative error of its eigenvalue is about its square, 1e-10. Ten
/// times more would allow errors of 1e-8.
const RESIDUAL: f64 = 1e-5;

/// Modes of a surface's sheet below the top of `bounds`.
pub(super) fn solve(surface: &Surface, bounds: &Bounds) -> Result<Found, PhysicsError> {
    match polygon::membrane(surface, bounds)? {
        Some((membrane, as_membrane)) => {
            let (solution, error) = converged(&membrane, &as_membrane).map_err(polygon::refusal)?;
            Ok(found(polygon::plate(solution, &as_membrane, bounds), bounds, polygon::of_plate(error)))
        }
        None => {
            let (solution, error) = converged(surface, bounds)?;
            Ok(found(solution, bounds, error))
        }
    }
}

/// The modes on a mesh fine enough for the accuracy, and a bound of the relative error of their frequencies, computed or from a cache, which
/// keeps them with the plan of the mesh.
fn converged(surface: &Surface, bounds: &Bounds) -> Result<(Solution, f64), PhysicsError> {
    let fabric = Fabric::of(surface)?;
    Cached::here().result_by(
        || key(surface, bounds),
        || refined(surface, &fabric, bounds),
        |(solution, error), to| {
            error.encode(to);
            solution.encode(to);
        },
        |from| {
            let error = f64::decode(from)?;
            Solution::decode(from, surface, &fabric, bounds).map(|solution| (solution, error))
        },
    )
}

/// The key of a solution in a cache.
fn key(surface: &Surface, bounds: &Bounds) -> String {
    format!("modes on a mesh: {:?} {:?} {bounds:?}", surface.outline, surface.sheet)
}

/// Whether the modes are in the cache.
pub(super) fn are_cached(surface: &Surface, bounds: &Bounds) -> Result<bool, PhysicsError> {
    let key = match polygon::membrane(surface, bounds)? {
        Some((membrane, as_membrane)) => key(&membrane, &as_membrane),
        None => key(surface, bounds),
    };
    Ok(Cached::here().holds(|| key))
}

/// Solves on finer and finer meshes until the error is small enough.
fn refined(surface: &Surface, fabric: &Fabric, bounds: &Bounds) -> Result<(Solution, f64), PhysicsError> {
    let (plan, memory) = affordable(surface, fabric, bounds)?;
    let coarse = plan.coarser(COARSER);
    let mesh = |number: usize| Observed::here().within(format!("mesh {number} of {} at most", 2 + ROUNDS));
    let mut levels = Vec::new();
    for plan in [&coarse.coarser(COARSER), &coarse] {
        // Of these, frequencies and shares alone are compared.
        let bounds = Bounds { lossy: false, ..*bounds };
        levels.push(modes(surface, fabric, &bounds, plan, &mesh(1 + levels.len()))?.level());
    }
    let third = coarse.coarser(1.0 / rates::finer(&levels, bounds.accuracy));
    // From levels that tell no rate the third has no edge length, and no cost.
    let fits = cost(surface, &third).is_ok_and(|(_, needed)| memory.holds(needed));
    let mut plan = if fits { third } else { plan };
    let mut best = Best::up_to(bounds.most);
    for _ in 0..ROUNDS {
        // The first of these plans is known to fit.
        if levels.len() > 2 && !memory.holds(cost(surface, &plan)?.1) {
            // Where meshes before tell their error, what is out of reach is the accuracy.
            if best.is_any() {
                break;
            }
            return Err(too_large(surface, bounds, &plan)?);
        }
        let mut fine = match modes(surface, fabric, bounds, &plan, &mesh(1 + levels.len())) {
            Err(PhysicsError::Solver { .. }) if best.is_any() => break,
            fine => fine?,
        };
        levels.push(fine.level());
        let unresolved = plan.unresolved();
        let error = rates::error(&levels) + unresolved;
        fine.state(&levels, unresolved);
        if error <= bounds.accuracy {
            return Ok((fine, error));
        }
        best.take(fine, error, STALLED);
        // The remaining error is rounding, or a corner that would need too many triangles.
        if best.is_stalled(PATIENCE) {
            break;
        }
        plan = plan.refined(error, bounds.accuracy);
    }
    let Bounds { max_hz, accuracy: expected, .. } = *bounds;
    best.end().map_err(|found| PhysicsError::NotConverged { max_hz, expected, found })
}

/// The plan for the accuracy aimed at, or, if that needs too much memory, for the best accuracy that memory
/// allows and that is accepted; with the memory that finer meshes may take.
///
/// # Errors
/// [`PhysicsError::TooLarge`] where there is none, so that nothing is solved in vain.
fn affordable(surface: &Surface, fabric: &Fabric, bounds: &Bounds) -> Result<(Plan, Memory), PhysicsError> {
    // What is chosen by itself is the same on every machine.
    let (usual, all) = (Memory::default(), Memory::here());
    let with = |accuracy: f64| Plan::new(surface, fabric, &Bounds { accuracy, ..*bounds });
    let mut accuracy = bounds.accuracy;
    while accuracy <= bounds.most {
        let plan = with(accuracy)?;
        let needed = cost(surface, &plan)?.1;
        if usual.holds(needed) {
            return if all.holds(needed) {
                Ok((plan, usual))
            } else {
                Err(too_large(surface, bounds, &plan)?)
            };
        }
        accuracy *= RELAXED;
    }
    let least = with(bounds.most)?;
    match all.holds(cost(surface, &least)?.1) {
        true => Ok((least, all)),
        false => Err(too_large(surface, bounds, &least)?),
    }
}

/// Meshes a sheet as planned, assembles its matrices and solves for the modes below the top. The plan must be known to fit in memory.
fn modes(
    surface: &Surface,
    fabric: &Fabric,
    bounds: &Bounds,
    plan: &Plan,
    observed: &Observed,
) -> Result<Solution, PhysicsError> {
    observed.part(|| "triangles".into());
    let (mesh, space) = meshed(surface, fabric, plan)?;
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
    let mut pairs = settled(pairs, surface, bounds);
    let bent = spectrum::works(forms.bending.as_ref(), pairs.vectors.as_ref());
    let share = |m: usize| {
        let (energy, square) = (bent[m], pairs.values[m]);
        if square > 0.0 { (energy / square).clamp(0.0, 1.0) } else { 0.0 }
    };
    let bending_shares: Vec<f64> = (0..pairs.values.len()).map(share).collect();
    let second = second(surface, (fabric, bounds), &pairs, &bending_shares, forms.bending.as_ref());
    let errors = second.into_iter().map(|second| Errors { second, ..Errors::default() }).collect();
    space.nodal(&mut pairs.vectors);
    Ok(Solution { plan: plan.clone(), space, pairs, bending_shares, errors, edge: mean_edge(&mesh) })
}

/// What a loss factor changes to second order, of each mode; infinite, where tension or springs act as well, for other laws of damping and
/// where it is not asked for.
fn second(
    surface: &Surface,
    (fabric, bounds): (&Fabric, &Bounds),
    pairs: &Pairs,
    shares: &[f64],
    bending: SparseColMatRef<usize, f64>,
) -> Vec<f64> {
    let edges: Vec<Edge> =
        surface.outline.loops().iter().flat_map(|rim| rim.sides.iter().map(|(_, edge)| *edge)).collect();
    let sprung = edges.iter().any(|edge| matches!(edge, Edge::Elastic { .. }));
    if !(fabric.bends() && (surface.sheet.tension > 0.0 || sprung)) {
        return losses::uncoupled(shares);
    }
    let Decay::LossFactor(eta) = surface.sheet.decay else { return vec![f64::INFINITY; shares.len()] };
    if !bounds.lossy {
        return vec![f64::INFINITY; shares.len()];
    }
    let forces = spectrum::symmetric_times(bending, pairs.vectors.as_ref());
    let between = product(pairs.vectors.transpose(), forces.as_ref());
    let far = losses::far(&edges, surface.sheet.uneven.is_uniform());
    losses::second(&pairs.values, between.as_ref(), far, 1.0 / eta)
}

/// Sets the eigenvalues of rigid-body modes, which differ from 0 by rounding errors, to 0. The lowest
/// eigenvalues, as many as the sheet has rigid-body motions, are set if their frequencies are below a tenth
/// of that expected of the first mode of a plate with as many modes; any others if below a thousandth of
/// it.
fn settled(mut pairs: Pairs, surface: &Surface, bounds: &Bounds) -> Pairs {
    let first = bounds.top_square() / (pairs.values.len().max(1) as f64).powi(2);
    let rigid = rigid_motions(surface);
    for (m, square) in pairs.values.iter_mut().enumerate() {
        let most = if m < rigid { 1e-2 } else { 1e-6 };
        if *square < most * first {
            *square = 0.0;
        }
    }
    pairs
}

/// The number of rigid-body motions of a sheet that store no energy: none if an edge resists displacement;
/// else one up and down, and two tilts unless tension or springs resist them.
fn rigid_motions(surface: &Surface) -> usize {
    let outline = &surface.outline;
    let tilts = |edge: &Edge| matches!(edge, Edge::Elastic { tilt, .. } if *tilt > 0.0);
    let tilted = outline.loops().iter().any(|rim| rim.sides.iter().any(|(_, edge)| tilts(edge)));
    match (outline.resists_displacement(), surface.sheet.tension > 0.0 || tilted) {
        (true, _) => 0,
        (false, true) => 1,
        (false, false) => 3,
    }
}

/// The modes of a solution, with the added mass of air and a definite sign.
fn found(solution: Solution, bounds: &Bounds, error: f64) -> Found {
    let Solution { space, pairs, bending_shares, errors, .. } = solution;
    let (omegas, factors): (Vec<f64>, Vec<f64>) =
        pairs.values.iter().map(|square| bounds.loaded(square.max(0.0))).unzip();
    let signed = |m: usize| factors[m] * sign(pairs.vectors.col(m));
    let factors: Vec<f64> = (0..omegas.len()).map(signed).collect();
    let vectors = &pairs.vectors;
    let coefficients = Mat::from_fn(vectors.nrows(), vectors.ncols(), |u, m| vectors[(u, m)] * factors[m]);
    let shapes = Box::new(MeshShapes::new(space, coefficients.as_ref()));
    Found { omegas, bending_shares, shapes, error, errors }
}

/// The cost of a solution, on the three meshes that most surfaces take.
pub(super) fn estimate(surface: &Surface, bounds: &Bounds) -> Result<Cost, PhysicsError> {
    let as_membrane = polygon::membrane(surface, bounds)?;
    let as_plate = as_membrane.is_some();
    let (surface, bounds) =
        as_membrane.as_ref().map_or((surface, bounds), |(surface, bounds)| (surface, bounds));
    let refused = |error| if as_plate { polygon::refusal(error) } else { error };
    let (fine, _) = affordable(surface, &Fabric::of(surface)?, bounds).map_err(refused)?;
    let coarse = fine.coarser(COARSER);
    let each = |plan: &Plan| {
        let (unknowns, bytes) = cost(surface, plan)?;
        let n = unknowns as f64;
        Ok(Cost { seconds: spectrum::seconds(n, plan.modes() as f64) + MESHING * n, bytes })
    };
    [coarse.coarser(COARSER), coarse, fine].iter().map(each).sum()
}

/// Approximate number of unknowns of a plan, and the memory (bytes) that a solution takes.
fn cost(surface: &Surface, plan: &Plan) -> Result<(usize, f64), PhysicsError> {
    let unknowns = plan.unknowns(&surface.outline)?;
    Ok((unknowns, spectrum::estimate_bytes(unknowns, plan.modes())))
}

/// The error for a plan that would not fit in memory, with the top frequency up to which it would. It takes some forty estimates of the
/// cost, which on thin films with boundary layers are a tenth of a second each.
fn too_large(surface: &Surface, bounds: &Bounds, plan: &Plan) -> Result<PhysicsError, PhysicsError> {
    let (unknowns, needed) = cost(surface, plan)?;
    let (mut fits, mut fails) = (0.0, 1.0);
    for _ in 0..40 {
        let share = 0.5 * (fits + fails);
        let needed = cost(surface, &plan.lower(share))?.1;
        if Memory::here().holds(needed) { fits = share } else { fails = share }
    }
    // Waves on a plate shorten as the root of the frequency.
    let nearest_hz = bounds.medium.omega(bounds.k_top * fits) / TAU;
    Ok(PhysicsError::too_large(bounds.max_hz, unknowns, needed, nearest_hz))
}
