//! Supported plates on convex polygons, whose modes are those of a membrane of the same outline.
//!
//! On a straight supported side w = 0 and ∇²w = 0, so a mode of the membrane (∇²w + k²w = 0, w = 0) satisfies all conditions of the
//! plate, and without re-entrant corners there are no others: ρ_s ω² = T k² + D k⁴ (Conway, *J. Appl. Mech.* 28, 288, 1961). The membrane is
//! far smoother at corners: at one of interior angle α it varies as r^(π/α), so that the energy within r is as r^(2π/α); the plate's
//! curvature varies as r^(π/α - 2), and its energy as r^(2π/α - 2), which at corners just short of 180° no grading of a mesh resolves. At
//! re-entrant corners the mode of the membrane has infinite bending energy, and the two differ (Sapondzhyan's paradox).

use super::solution::Solution;
use crate::modes::bounds::Bounds;
use crate::modes::found::Errors;
use crate::modes::losses;
use crate::{Medium, PhysicsError};
use std::f64::consts::PI;
use unripple_core::plane::Rims;
use unripple_core::{Edge, Surface};

/// Interior angles that exceed a straight angle by up to this, in radians, count as straight: rounding
/// errors of coordinates on one line. The singular part of the plate's deflection at such a corner is as
/// small.
const STRAIGHT: f64 = 1e-6;

/// The membrane that has the modes of a supported plate on a convex polygon, and the request for its modes
/// with half the requested error, since a relative error of wavenumbers is up to doubled in frequencies.
/// `None` for any other surface.
///
/// # Errors
/// [`PhysicsError::Outline`] for an invalid outline.
pub(super) fn membrane(
    surface: &Surface,
    bounds: &Bounds,
) -> Result<Option<(Surface, Bounds)>, PhysicsError> {
    if bounds.medium.bending_stiffness <= 0.0 || !surface.sheet.uneven.is_uniform() {
        return Ok(None);
    }
    let rims = Rims::new(&surface.outline)?;
    let straight = rims.sides.iter().all(|(side, edge)| side.is_straight() && *edge == Edge::Supported);
    if !straight || rims.angles.iter().any(|angle| *angle > PI + STRAIGHT) {
        return Ok(None);
    }
    let mut membrane = surface.clone();
    // The tension whose waves at the top have the plate's frequency.
    let tension = bounds.medium.tension + bounds.medium.bending_stiffness * bounds.k_top.powi(2);
    (membrane.sheet.young, membrane.sheet.tension) = (0.0, tension);
    let medium = Medium { tension, bending_stiffness: 0.0, air_sides: 0.0, ..bounds.medium };
    let [accuracy, most] = [bounds.accuracy, bounds.most].map(of_membrane);
    let as_membrane = Bounds { medium, accuracy, most, ..*bounds };
    Ok(Some((membrane, as_membrane)))
}

/// The modes of the plate from the modes of the membrane.
pub(super) fn plate(membrane: Solution, as_membrane: &Bounds, bounds: &Bounds) -> Solution {
    let Solution { mut pairs, mut bending_shares, mut errors, .. } = membrane;
    let (of_membrane, of_plate) = (as_membrane.vacuum(), bounds.vacuum());
    for (square, share) in pairs.values.iter_mut().zip(&mut bending_shares) {
        let k = of_membrane.wavenumber(square.sqrt());
        *square = of_plate.omega(k).powi(2);
        *share = of_plate.bending_share(k);
    }
    // The share is D k²/(T + D k²).
    for (errors, second) in errors.iter_mut().zip(losses::uncoupled(&bending_shares)) {
        let doubled = self::of_plate(errors.frequency);
        *errors = Errors { frequency: doubled, share: doubled, shape: errors.shape, second };
    }
    Solution { pairs, bending_shares, errors, ..membrane }
}

/// The error to report for the plate, given the error of solving for the membrane.
/// ω² of the plate is that of the membrane squared, so that what fits is less of its band.
pub(super) fn refusal(of_membrane: PhysicsError) -> PhysicsError {
    match of_membrane {
        PhysicsError::TooLarge { max_hz, unknowns, needed_gib, limit_gib, nearest_hz } => {
            let nearest_hz = max_hz * (nearest_hz / max_hz).powi(2);
            PhysicsError::TooLarge { max_hz, unknowns, needed_gib, limit_gib, nearest_hz }
        }
        PhysicsError::NotConverged { max_hz, expected, found } => {
            PhysicsError::NotConverged { max_hz, expected: of_plate(expected), found: of_plate(found) }
        }
        other => other,
    }
}

/// The largest relative error of the plate's frequencies, which grow as k² + T/D at most, given the
/// relative error of the membrane's frequencies.
pub(super) fn of_plate(error: f64) -> f64 {
    2.0 * error
}

/// The relative error to request of the membrane's frequencies for a relative error of the plate's.
fn of_membrane(error: f64) -> f64 {
    0.5 * error
}
