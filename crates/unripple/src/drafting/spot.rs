use crate::act::{ActError, CELLS};
use crate::core::{Point, Responses};
use crate::field::Field;
use crate::focus::{Options, Target, focus};

/// What time reversal gives at one place, at its focal instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The place.
    pub at: Point,
    /// The window T, in seconds.
    pub window: f64,
    /// Velocity there at T, in m/s, at the drive limit.
    pub peak_velocity: f64,
    /// That over the rms outside the focal disc: the `contrast` of `unripple focus`; `None` where nothing moves or is outside.
    pub contrast: Option<f64>,
}

/// A focus at one place, judged at its focal instant only.
pub(super) fn spot(responses: &Responses, at: Point, options: &Options) -> Result<Spot, ActError> {
    let focused = focus(responses, &[Target::at(at)], options)?;
    let drive = focused.drive.as_emitted();
    let instant = focused.timing.first().map_or(0.0, |timing| timing.instant as f64 / drive.rate());
    let field = Field::new(responses, &drive, CELLS)?;
    let trace = field.traces(&[at], instant)?;
    let peak = trace.first().and_then(|trace| trace.velocity.last()).copied().unwrap_or(0.0);
    let shots = field.snapshots(&[instant])?;
    let radius = responses.conditions().focal_radius();
    let values = shots.iter().flat_map(|shot| field.points().iter().zip(&shot.velocity));
    let outside = values.filter(|(point, _)| point.distance(at) > radius);
    let (count, squares) =
        outside.fold((0usize, 0.0), |(count, sum), (_, v)| (count + 1, sum + f64::from(*v).powi(2)));
    let rms = (squares / count.max(1) as f64).sqrt();
    let contrast = (rms > 0.0).then(|| peak.abs() / rms);
    Ok(Spot { at, window: options.window, peak_velocity: peak, contrast })
}
