//! What a search for places costs, before anything is solved.

use super::Ask;
use super::ask::TESTED;
use super::budget::{JUDGED, SEARCHED, most};
use crate::Progress;
use crate::cost;
use unripple::act::{ActError, judging_cost, model_cost};
use unripple::core::{Actuator, Cost, Point, Surface};
use unripple::physics::design::expected_modes;

/// Floating-point operations per second in single precision over those in double precision.
const SINGLE: f64 = 2.0;

/// Columns that are evaluated beside the places: layouts of random, perturbed and other numbers of actuators, for each actuator.
const EVALUATED: usize = 100;

/// Points of fields over those that are read where they are thinned.
const THINNED: usize = 4;

/// Nodes of where each place may be, where it is known to within an error.
const NODES: usize = 4;

/// Tells what the search among `places` will cost, on a surface with the kept actuators, for actuators like `kind`.
pub(super) fn announce(
    ask: &Ask,
    (surface, kind): (&Surface, &Actuator),
    places: &[Point],
    progress: &mut dyn Progress,
) {
    let less = match ask.by {
        None => "a lower top of the band, a larger pitch of the places or fewer targets",
        Some(_) => "a lower top of the band or fewer evaluations",
    };
    // What cannot be estimated is refused where it is computed.
    if let (Ok(model), Ok(second)) =
        (model_cost(surface, None, &[]), second_search(ask, surface, kind, places))
    {
        cost::announce(model + second + search(ask, surface, places.len()), less, progress);
    }
}

/// The cost of the drives of a second search, whose fields are read at a fourth of the points, and of those with which it ends.
fn second_search(ask: &Ask, kept: &Surface, kind: &Actuator, places: &[Point]) -> Result<Cost, ActError> {
    if ask.by.is_none() {
        return Ok(Cost::default());
    }
    let mut surface = kept.clone();
    let put = |(i, at): (usize, &Point)| Actuator { name: format!("place {i}"), at: *at, ..kind.clone() };
    surface.actuators.extend(places.iter().take(ask.count).enumerate().map(put));
    let drives = most(ask) * SEARCHED / THINNED + 2 * JUDGED;
    judging_cost(&surface, None, &[], ask.window_s, drives)
}

/// The cost of the fields of all places and of layouts; the search itself is short beside them.
fn search(ask: &Ask, surface: &Surface, places: usize) -> Cost {
    let modes = expected_modes(surface, surface.emission.band[1]);
    let trained = if ask.points_m.is_empty() { ask.targets } else { ask.points_m.len() } as f64;
    let tested = if ask.points_m.is_empty() { TESTED as f64 * trained } else { trained };
    let nodes = if ask.mounting_m > 0.0 { NODES } else { 1 };
    let models = if ask.tension > 0.0 { 3.0 } else { 1.0 };
    let columns = (nodes * places) as f64 * trained + (EVALUATED * ask.count) as f64 * tested;
    // Two products of modes x modes with a column, and rows of products of all places.
    let operations =
        models * (4.0 * modes * modes * columns + 2.0 * modes * trained * (places as f64).powi(2));
    let bytes = 4.0 * models * trained * places as f64 * (2.0 * modes + places as f64);
    Cost { bytes, ..Cost::of_operations(operations / SINGLE) }
}
