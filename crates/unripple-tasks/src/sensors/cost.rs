//! What the information of many places costs, before anything is solved.

use crate::{Progress, cost};
use unripple::act::model_cost;
use unripple::core::{Cost, Surface};
use unripple::physics::design::expected_modes;

/// Distance between the frequencies of a fit, in Hz.
const LINE: f64 = 10.0;

/// Unknowns of each actuator: place, mass, damping and gain.
const EACH: f64 = 5.0;

/// Unknowns of the sheet, without its profile of tension.
const SHEET: f64 = 8.0;

/// Operations of the small sums of a place for each that a large product of matrices would take in the same time.
const SMALL: f64 = 4.0;

/// Tells what the information of so many places will cost, with a model up to `max_hz`, where it takes long.
pub(super) fn announce(
    surface: &Surface,
    (places, profile): (usize, usize),
    (top, max_hz): (f64, f64),
    progress: &mut dyn Progress,
) {
    // What cannot be estimated is refused where it is computed.
    let Ok(model) = model_cost(surface, Some(max_hz), &[]) else { return };
    let (modes, actuators) = (expected_modes(surface, max_hz), surface.actuators.len() as f64);
    let terms = (profile * (profile + 3) / 2) as f64;
    let (unknowns, places) = (SHEET + terms + EACH * actuators, places as f64);
    let (lines, columns) = (top / LINE, 2.0 * actuators * (11.0 + terms));
    let fields = 2.0 * lines * columns * modes * (places + modes);
    let sums = SMALL * lines * places * 2.0 * actuators * unknowns * unknowns;
    let search = SMALL * places * unknowns.powi(3);
    let bytes = 8.0 * places * (3.0 * unknowns * unknowns + 8.0 * columns);
    let cost = model + Cost { bytes, ..Cost::of_operations(fields + sums + search) };
    cost::announce(
        cost,
        "a lower top of the band, a larger pitch of the places or fewer terms of the profile",
        progress,
    );
}
