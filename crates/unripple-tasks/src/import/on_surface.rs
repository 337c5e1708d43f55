//! What files name, on the surface: its actuators, its points, and its band.

use super::Ask;
use super::measured::Who;
use crate::TaskError;
use crate::window::conditions;
use unripple::core::{Conditions, Point, Surface};
use unripple::physics::Medium;

/// Distance in metres within which a place in a file is that of an actuator: places are written to a tenth of a millimetre or so.
const NEAR: f64 = 0.5e-3;

/// Places per metre that are told apart: a nanometre.
const PER_METRE: f64 = 1e9;

/// A place to the nanometre, as a key.
pub(super) fn key(at: Point) -> [i64; 2] {
    [at.x, at.y].map(|coordinate| (coordinate * PER_METRE).round() as i64)
}

/// Refuses a place off the sheet.
pub(super) fn on_sheet(surface: &Surface, at: Point, from: &str) -> Result<(), TaskError> {
    match at.is_finite() && surface.outline.contains(at) {
        true => Ok(()),
        false => Err(TaskError::Input(format!(
            "{from}: expected a point on the surface, found {at}, off its edge"
        ))),
    }
}

/// How it is known which actuator a file means, the surest way first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum By {
    /// The request names it.
    Request,
    /// The file has its name.
    Name,
    /// It is the nearest one.
    Place,
}

/// The actuator that a file means, and how it is known: by the request, by its name, or by its place.
pub(super) fn resolved(
    ask: &Ask,
    surface: &Surface,
    who: &Who,
    from: &str,
) -> Result<(usize, By), TaskError> {
    let named = |name: &String| surface.actuators.iter().position(|actuator| actuator.name == *name);
    let asked = ask.actuator_names.iter().find(|(_, other)| who.names.contains(other)).map(|(name, _)| name);
    let asked = asked.and_then(named).map(|actuator| (actuator, By::Request));
    let known = asked.or_else(|| who.names.iter().find_map(named).map(|actuator| (actuator, By::Name)));
    let near = || {
        let at = who.at?;
        let near = (0..surface.actuators.len()).filter(|a| surface.actuators[*a].at.distance(at) <= NEAR);
        near.min_by(|a, b| {
            let distance = |a: usize| surface.actuators[a].at.distance(at);
            distance(*a).total_cmp(&distance(*b))
        })
    };
    known.or_else(|| near().map(|actuator| (actuator, By::Place))).ok_or_else(|| {
        let all: Vec<&str> = surface.actuators.iter().map(|actuator| actuator.name.as_str()).collect();
        let found = match who.at {
            Some(at) => format!("`{}` at {at}", who.names.join("`, `")),
            None => format!("`{}`", who.names.join("`, `")),
        };
        TaskError::ask(
            "actuator_names",
            format!("one of {} by name or place, or which of them it is", all.join(", ")),
            format!("{found} ({from})"),
        )
    })
}

/// Rate, band, wavelength and outline of responses that hold a band.
pub(super) fn limited(surface: &Surface, [low, high]: [f64; 2]) -> Result<Conditions, TaskError> {
    if low >= high {
        let [least, most] = surface.emission.band;
        return Err(TaskError::ask(
            "band_hz",
            format!("responses with frequencies of the surface's band, {least} to {most} Hz"),
            format!("none between {low} and {high} Hz"),
        ));
    }
    let lambda_min = Medium::of(&surface.sheet).lambda_min(high);
    Ok(Conditions { band: [low, high], lambda_min, ..conditions(surface) })
}
