//! Choices of places that keep a distance from each other.

use crate::PlacementError;
use std::ops::Range;
use unripple_core::{Point, Random};

/// Distance in metres below which two places are one. Neither an actuator nor a sensor is that small.
const COINCIDENT: f64 = 1e-6;

/// Number of random choices that are tried before the places count as too close to each other.
const TRIES: usize = 100;

/// Whether two places are at least so far apart, in metres, and are not one.
pub(crate) fn are_apart(one: Point, other: Point, apart: f64) -> bool {
    one.distance(other) >= apart.max(COINCIDENT)
}

/// Random choices of `count` of the `places`, in addition to all indices before these; `free` says whether one may be added to a choice.
///
/// # Errors
/// [`PlacementError::Few`] if none was found in which all may be.
pub(crate) fn random(
    places: Range<usize>,
    count: usize,
    choices: usize,
    seed: u64,
    free: impl Fn(&[usize], usize) -> bool,
) -> Result<Vec<Vec<usize>>, PlacementError> {
    let mut random = Random::seeded(seed);
    let (kept, all) = (places.start, places.len());
    let mut most = 0;
    let mut one = || {
        for _ in 0..TRIES {
            let mut chosen: Vec<usize> = (0..kept).collect();
            let mut order: Vec<usize> = places.clone().collect();
            for i in 0..all {
                let j = i + ((random.uniform() * (all - i) as f64) as usize).min(all - i - 1);
                order.swap(i, j);
                if chosen.len() < kept + count && free(&chosen, order[i]) {
                    chosen.push(order[i]);
                }
            }
            if chosen.len() == kept + count {
                return Ok(chosen);
            }
            most = most.max(chosen.len() - kept);
        }
        Err(PlacementError::Few { expected: count, found: most })
    };
    (0..choices).map(|_| one()).collect()
}
