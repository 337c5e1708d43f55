//! Velocity and contrast of a time-reversal focus at one point.

use crate::act::{ActError, CELLS};
use crate::core::{Point, Responses};
use crate::field::Field;
use crate::focus::{Options, Target, focus};

/// Velocity and contrast of a time-reversal focus at one point, at its focal instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The target point, in metres.
    pub at: Point,
    /// The window T, in seconds.
    pub window: f64,
    /// Velocity at the target at the focal instant T, in m/s, with the drive at its limit.
    pub peak_velocity: f64,
    /// Contrast: the magnitude of `peak_velocity` over the rms velocity outside the focal disc, on the
    /// modes of the band; `None` where nothing moves outside, or nothing is outside.
    pub contrast: Option<f64>,
}

/// A focus at one place, evaluated at its focal instant only.
pub(super) fn spot(responses: &Responses, at: Point, options: &Options) -> Result<Spot, ActError> {
    let focused = focus(responses, &[Target::at(at)], options)?;
    let instant = focused.instant();
    let drive = focused.drive.as_emitted();
    let field = Field::new(responses, &drive, CELLS)?;
    let found = field.at_instant(instant, &[at], &[at])?;
    Ok(Spot { at, window: options.window, peak_velocity: found.velocity, contrast: found.contrast() })
}
