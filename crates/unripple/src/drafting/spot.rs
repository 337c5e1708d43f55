//! Figures of a time-reversal focus at one place.

use crate::act::{ActError, CELLS};
use crate::core::{Point, Responses};
use crate::field::Field;
use crate::focus::{Options, Target, focus};

/// Figures of a time-reversal focus at one place, at its focal instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The place, in metres.
    pub at: Point,
    /// The window T, in seconds.
    pub window: f64,
    /// Velocity there at T, in m/s, at the drive limit.
    pub peak_velocity: f64,
    /// That over the rms outside the focal disc: the `contrast` of `unripple focus`; `None` where nothing moves or is outside.
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
