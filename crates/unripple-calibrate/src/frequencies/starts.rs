//! Starts of a fit: from the file's values and from others, at every common scale at which the frequencies could be modes.

use super::matching::matched;
use super::model::Model;
use super::solve::{Problem, Solved, solved};
use crate::CalibrateError;
use unripple_core::Observed;

/// Most starts that are followed: the deepest minima of the scan. The right one is nearly always the first.
const STARTS: usize = 6;

/// Factor on a single quantity, as a logarithm, for starts of other proportions: a fourfold or a quarter.
const APART: f64 = 1.386;

/// The scan goes this far either way, as a logarithm of frequencies: a factor of 8, 64 in stiffness.
const SPAN: f64 = 2.08;

/// Step of the scan in deviations of a frequency.
const FINE: f64 = 0.5;

/// Modes that may have been missed beside as many as were heard.
const MORE: usize = 6;

/// Least deviation of a frequency with which starts are looked for and first followed: proportions that are a little off are to match many
/// modes badly rather than few of them well.
const COARSE: f64 = 0.03;

/// Two solutions whose logarithms differ by less than this are one; and two places, found with the coarse deviation, that are near enough
/// to lead to one.
const SAME: f64 = 1e-3;
const NEAR: f64 = 1e-2;

/// Minima of the cost, the lowest first, each found from one of several starts, and the number of starts.
///
/// # Errors
/// Those of computing modes, if they fail from every start.
pub(super) fn minima(model: &Model<'_>, problem: &Problem) -> Result<(Vec<Solved>, usize), CalibrateError> {
    let mut failed = None;
    let mut scanned: Vec<(f64, Vec<f64>)> = Vec::new();
    let coarse = Problem { deviation: problem.deviation.max(COARSE), ..problem.clone() };
    let shapes = proportions(model.free.len());
    let observed = Observed::here();
    observed.part(|| "starts".into());
    let steps = observed.steps(shapes.len() + STARTS);
    for shape in shapes {
        match scan(model, &coarse, &shape) {
            Ok(found) => scanned.extend(found),
            Err(error) => failed = Some(error),
        }
        steps.take(1.0);
    }
    scanned.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<Solved> = Vec::new();
    let mut followed = 0;
    let mut reached: Vec<Solved> = Vec::new();
    for (_, start) in scanned.into_iter().take(STARTS) {
        followed += 1;
        let result = solved(model, &coarse, &start).and_then(|near| {
            // What leads to the same place is followed once.
            let known = reached.iter().any(|other| same(&near, other, NEAR));
            let fine = if known { None } else { Some(solved(model, problem, &near.logs)?) };
            reached.push(near);
            Ok(fine)
        });
        match result {
            Ok(Some(one)) if found.iter().all(|other| !same(&one, other, SAME)) => found.push(one),
            Ok(_) => {}
            Err(error) => failed = Some(error),
        }
        steps.take(1.0);
    }
    found.sort_by(|a, b| a.matching.cost.total_cmp(&b.matching.cost));
    match failed {
        Some(error) if found.is_empty() => Err(error),
        _ => Ok((found, followed)),
    }
}

/// Whether two solutions are one: the same assignment, and logarithms that differ by less than `by`.
fn same(a: &Solved, b: &Solved, by: f64) -> bool {
    a.matching.pairs == b.matching.pairs && a.logs.iter().zip(&b.logs).all(|(a, b)| (a - b).abs() < by)
}

/// Logarithms of factors on `count` quantities: none, and each of them alone larger and smaller.
fn proportions(count: usize) -> Vec<Vec<f64>> {
    let mut all = vec![vec![0.0; count]];
    if count > 1 {
        for which in 0..count {
            for by in [APART, -APART] {
                let mut shape = vec![0.0; count];
                shape[which] = by;
                all.push(shape);
            }
        }
    }
    all
}

/// Local minima of the cost over a common factor on all free quantities, from a single solution: every frequency is taken to be
/// proportional to the root of the factor. Gives the cost and the logarithms of each.
fn scan(model: &Model<'_>, problem: &Problem, shape: &[f64]) -> Result<Vec<(f64, Vec<f64>)>, CalibrateError> {
    let count = 2 * problem.logs.len() + MORE;
    let modes = model.lowest(shape, count)?.logs();
    let steps = (SPAN / (FINE * problem.deviation)).ceil().min(2000.0) as i32;
    let by = |step: i32| SPAN * f64::from(step) / f64::from(steps);
    let cost = |step: i32| {
        let moved: Vec<f64> = modes.iter().map(|log| log + by(step)).collect();
        matched(&problem.logs, &moved, problem.deviation).cost
    };
    let costs: Vec<f64> = (-steps..=steps).map(cost).collect();
    let at = |i: usize| costs.get(i).copied().unwrap_or(f64::INFINITY);
    let is_least = |i: &usize| at(*i) <= at(i.wrapping_sub(1)) && at(*i) < at(i + 1);
    let mut least: Vec<usize> = (0..costs.len()).filter(is_least).collect();
    least.sort_by(|a, b| at(*a).total_cmp(&at(*b)));
    least.truncate(STARTS);
    let start = |i: usize| {
        let common = 2.0 * by(i as i32 - steps);
        (at(i), shape.iter().map(|log| log + common).collect())
    };
    Ok(least.into_iter().map(start).collect())
}
