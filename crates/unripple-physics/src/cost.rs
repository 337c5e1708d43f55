//! What the responses of a surface cost, before anything is solved.

use crate::coupled::{coordinates_of_loads, guard};
use crate::design::expected_modes;
use crate::responses::Asked;
use crate::{Modes, PhysicsError, ResponseOptions};
use unripple_core::{Cost, Surface};

/// Operations for the modes with loads, as a multiple of the cube of their number, in products of matrices that take as long: an
/// eigenvalue problem and products with its vectors.
const COUPLED: f64 = 180.0;

/// Operations for the undamped modes with loads, as a multiple of the cube of their number, in products of matrices that take as long: a
/// symmetric eigenvalue problem and five products.
const UNDAMPED: f64 = 40.0;

/// Frequency up to which modes are damped one by one with a lattice of resonators, relative to that up to which they are coupled.
const CONDENSED: f64 = 1.4;

/// Operations for each damped mode with loads, relative to those of products: of small complex systems, some steps for each.
const DAMPED: f64 = 20.0;

/// The estimated cost of [`responses()`](crate::responses()): of the modes of the sheet, unless a cache holds them, and of those with loads.
///
/// # Errors
/// Those of [`responses()`](crate::responses()) that are known before solving, such as [`PhysicsError::TooLarge`].
///
/// ```
/// use unripple_physics::{ResponseOptions, design::papers_surface, response_cost};
///
/// let film = papers_surface();
/// let higher = ResponseOptions { max_hz: Some(9000.0), ..ResponseOptions::default() };
/// let [low, high] = [ResponseOptions::default(), higher].map(|o| response_cost(&film, &o).unwrap());
/// assert!(low.seconds < high.seconds && high.seconds < 60.0);
/// ```
pub fn response_cost(surface: &Surface, options: &ResponseOptions) -> Result<Cost, PhysicsError> {
    of(surface, &Asked::of(surface, options)?)
}

/// The estimated cost of a request.
pub(crate) fn of(surface: &Surface, asked: &Asked) -> Result<Cost, PhysicsError> {
    let (top, accuracy) = (asked.modes_hz(), asked.accuracy());
    let known = Modes::are_cached(surface, top, accuracy)?;
    let sheet = if known { Cost::default() } else { Modes::cost(surface, top, accuracy)? };
    let loads = asked.loads() as f64;
    if loads == 0.0 {
        return Ok(sheet);
    }
    if asked.on_lattice() {
        return of_lattice(surface, asked, sheet);
    }
    let rest = coordinates_of_loads(asked.loads()) as f64;
    let count = expected_modes(surface, asked.coupled_hz()) + rest;
    guard(count as usize, 0, asked.coupled_hz())?;
    let step = 4.0 * loads * loads * count + rest.powi(3) + 4.0 * rest * rest * loads;
    let coupled = Cost::of_operations(COUPLED * count.powi(3) + DAMPED * count * step);
    // Some thirty square matrices, with those of all oscillations.
    Ok(sheet + coupled + Cost { seconds: 0.0, bytes: 250.0 * count * count })
}

/// The estimated cost with many resonators, of whose coordinates all are coupled; `sheet` is that of the modes without loads.
fn of_lattice(surface: &Surface, asked: &Asked, sheet: Cost) -> Result<Cost, PhysicsError> {
    let loads = asked.loads() as f64;
    let count = expected_modes(surface, asked.modes_hz()) + loads;
    let damped = expected_modes(surface, CONDENSED * asked.coupled_hz()) + loads;
    guard(damped as usize, 0, asked.coupled_hz())?;
    let operations = UNDAMPED * count.powi(3) + COUPLED * damped.min(count).powi(3);
    let bytes = 100.0 * count * count + 320.0 * damped * damped;
    Ok(sheet + Cost::of_operations(operations) + Cost { seconds: 0.0, bytes })
}
