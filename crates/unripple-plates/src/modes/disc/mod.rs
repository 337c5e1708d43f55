//! Modes of round sheets by the Rayleigh-Ritz method, one angular order at a time.

mod energy;
mod order;
mod problem;
mod radial;
mod shapes;

use super::found::{Errors, Found};
use crate::PhysicsError;
use order::OrderModes;
use rayon::prelude::*;
use shapes::{Place, Round};
use std::f64::consts::TAU;
use unripple_core::{Cost, Memory, Observed};

pub(super) use problem::Problem;

/// Angular orders beyond ka, as a share of it, up to which modes are looked for: waves along a free rim are at most 1.5 % shorter than those
/// inside (Konenkov, *Sov. Phys. Acoust.* 6, 122, 1960), so that a mode of order n has ka of at least about n. With twice this value, some
/// orders more have no mode.
const BEYOND: f64 = 0.05;

/// Bytes for each (ka)³, by which a problem too large for the allowed memory is refused: six times the coefficients of all shapes, since
/// there are (ka)²/4 modes of ka/2 coefficients or less. With half this value, polynomials near the centre would be larger than numbers
/// may be, about 2^(0.7 (n + 2j)) for degrees n + 2j a little above ka.
const BYTES: f64 = 2.5;

/// Modes of a round sheet.
///
/// # Errors
/// [`PhysicsError::TooLarge`] if more memory would be needed than is allowed; [`PhysicsError::NotConverged`] if no number of functions
/// reaches the accuracy that is aimed at.
pub(super) fn solve(problem: &Problem) -> Result<Found, PhysicsError> {
    guard(problem)?;
    let last = (problem.bounds.k_top * problem.radius * (1.0 + BEYOND)) as usize + 3;
    let observed = Observed::here();
    observed.part(|| format!("{} angular orders", last + 1));
    let steps = observed.steps(last + 1);
    let orders: Vec<Option<OrderModes>> = (0..=last)
        .into_par_iter()
        .map(|n| OrderModes::solve(problem, n))
        .inspect(|_| steps.take(1.0))
        .collect();
    let of = |order: &Option<OrderModes>| order.as_ref().map_or(f64::INFINITY, OrderModes::error);
    let error = orders.iter().map(of).fold(0.0, f64::max);
    if error > problem.bounds.accuracy {
        let (max_hz, expected) = (problem.bounds.max_hz, problem.bounds.accuracy);
        return Err(PhysicsError::NotConverged { max_hz, expected, found: error });
    }
    let orders: Vec<OrderModes> = orders.into_iter().flatten().collect();
    let places = places(&orders);
    let square = |(n, m, _): &Place| orders[*n].squares[*m];
    let omegas = places.iter().map(|place| problem.bounds.loaded(square(place)).0).collect();
    let bending_shares = places.iter().map(|(n, m, _)| orders[*n].bending_shares[*m]).collect();
    let of = |(n, m, _): &Place| {
        let order = &orders[*n];
        match order.squares[*m] > 0.0 {
            true => Errors::of_ritz(order.error(), order.bending_shares[*m], order.second[*m]),
            false => Errors::default(),
        }
    };
    let errors = places.iter().map(of).collect();
    let factor = |square: &f64| problem.bounds.loaded(*square).1;
    let factors: Vec<Vec<f64>> =
        orders.iter().map(|order| order.squares.iter().map(factor).collect()).collect();
    let shapes = Box::new(Round::new(problem, orders, &places, &factors));
    Ok(Found { omegas, bending_shares, shapes, error, errors })
}

/// All modes in order of ascending frequency: each but those of order 0 as cosine and as sine.
fn places(orders: &[OrderModes]) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::new();
    for (n, order) in orders.iter().enumerate() {
        for m in 0..order.squares.len() {
            places.push((n, m, false));
            if n > 0 {
                places.push((n, m, true));
            }
        }
    }
    let square = |(n, m, _): &Place| orders[*n].squares[*m];
    places.sort_by(|a, b| square(a).total_cmp(&square(b)).then(a.cmp(b)));
    places
}

/// The cost of a solution, which takes milliseconds.
///
/// # Errors
/// [`PhysicsError::TooLarge`] if it does not fit in memory.
pub(crate) fn cost(problem: &Problem) -> Result<Cost, PhysicsError> {
    Ok(Cost { seconds: 0.0, bytes: guard(problem)? })
}

/// The memory that a problem takes, in bytes; refuses one that would not fit, before any is allocated.
fn guard(problem: &Problem) -> Result<f64, PhysicsError> {
    let reach = problem.bounds.k_top * problem.radius;
    let needed = BYTES * reach.powi(3);
    let memory = Memory::here();
    if memory.holds(needed) {
        return Ok(needed);
    }
    let nearest = problem.bounds.k_top * (memory.bytes() / needed).cbrt();
    let nearest_hz = problem.bounds.medium.omega(nearest) / TAU;
    Err(PhysicsError::too_large(problem.bounds.max_hz, (0.5 * reach) as usize, needed, nearest_hz))
}
