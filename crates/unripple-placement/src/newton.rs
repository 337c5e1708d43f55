//! Shares of measurements among the places in use, by Newton's method (C. L. Atwood, *Ann. Statist.* 4, 1124, 1976).

use crate::Informations;
use crate::informations::{Solved, log_det_of, packed};
use rayon::prelude::*;
use unripple_linalg::{Cholesky, Mat};

/// Largest number of steps. It settles in a few, and loses a place with some.
const STEPS: usize = 100;

/// Largest difference of a sensitivity from the number of unknowns, relative to it, at which shares have settled: a hundredth of what
/// certifies a design, or (`SHARE`) this share of the excess elsewhere, which another place will change anyway.
const SETTLED: f64 = 1e-8;
const SHARE: f64 = 1e-2;

/// What is added to the diagonal of the equations, relative to its largest entry: places that tell the same have one share in common.
const RIDGE: f64 = 1e-10;

/// Share below which a place is left.
const LEAST: f64 = 1e-12;

/// Loss of ln det, for each unknown, that is rounding.
const ROUNDING: f64 = 1e-12;

/// Halvings of a step that does not gain.
const HALVINGS: usize = 30;

/// Changes the shares of the places in use so that the determinant of the information of `count` measurements is largest. `excess` is that of
/// the largest sensitivity of all places, relative to the number of unknowns.
pub(crate) fn shared(all: &Informations, weights: &mut [f64], count: usize, excess: f64) {
    let unknowns = all.unknowns();
    let settled = SETTLED.max(SHARE * excess);
    for _ in 0..STEPS {
        let used: Vec<usize> = (0..weights.len()).filter(|place| weights[*place] > 0.0).collect();
        let Some(solved) = Solved::of(&all.by_shares(weights, count), unknowns) else { return };
        let each: Vec<Vec<f64>> =
            used.par_iter().map(|place| all.all_within(&solved.lower, *place, count)).collect();
        let one = packed(&Mat::identity(unknowns, unknowns));
        let slopes: Vec<f64> = each.iter().map(|matrix| inner(matrix, &one)).collect();
        let level = unknowns as f64;
        if slopes.iter().all(|slope| (slope - level).abs() <= settled * level) {
            return;
        }
        let Some(step) = step(&each, &slopes) else { return };
        let before: Vec<f64> = used.iter().map(|place| weights[*place]).collect();
        let room = before.iter().zip(&step).filter(|(_, step)| **step < 0.0).map(|(x, step)| -x / step);
        let mut length = room.fold(1.0, f64::min);
        let gained = (0..HALVINGS).any(|_| {
            let moved = before.iter().zip(&step).map(|(x, step)| (x + length * step).max(0.0));
            put(weights, &used, &moved.collect::<Vec<f64>>());
            length *= 0.5;
            log_det_of(&all.by_shares(weights, count), unknowns) > solved.log_det - ROUNDING * level
        });
        if !gained {
            put(weights, &used, &before);
            return;
        }
    }
}

/// The shares of the places in use, without the smallest ones, with a sum of 1.
fn put(weights: &mut [f64], used: &[usize], to: &[f64]) {
    let kept = |x: f64| if x < LEAST { 0.0 } else { x };
    let total: f64 = to.iter().map(|x| kept(*x)).sum();
    used.iter().zip(to).for_each(|(place, x)| weights[*place] = kept(*x) / total);
}

/// Newton's step of shares whose sum stays: the second derivative by two shares is -tr(BC), B and C the matrices of both places.
fn step(each: &[Vec<f64>], slopes: &[f64]) -> Option<Vec<f64>> {
    let count = each.len();
    let mut system = Mat::from_fn(count, count, |i, j| inner(&each[i], &each[j]));
    let most = (0..count).map(|i| system[(i, i)]).fold(0.0, f64::max);
    (0..count).for_each(|i| system[(i, i)] += RIDGE * most);
    let mut both = Mat::from_fn(count, 2, |i, j| if j == 0 { slopes[i] } else { 1.0 });
    Cholesky::new(system.as_ref())?.solve(both.as_mut());
    let total = |j: usize| (0..count).map(|i| both[(i, j)]).sum::<f64>();
    let level = total(0) / total(1);
    Some((0..count).map(|i| both[(i, 0)] - level * both[(i, 1)]).collect())
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
