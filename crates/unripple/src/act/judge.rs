//! Evaluation of the field of a drive on a surface: metrics, traces, maps.

use super::note::{self, Note};
use super::{ActError, Sound, power};
use crate::core::{Point, Surface};
use crate::field::{Aim, Field, Measured, Reach, Trace};
use crate::physics::design::{Linearity, linearity};

/// Evaluation of the field of a drive: metrics, traces, maps, warnings.
#[derive(Clone, Debug)]
pub struct Judged {
    /// All metrics and maps of the field.
    pub measured: Measured,
    /// Velocity and displacement at the first point of each target, from the drive's first sample on.
    pub traces: Vec<Trace>,
    /// End of the traces, in seconds.
    pub until: f64,
    /// Slopes, strains and added tension of the field; `None` for sampled responses, which are on no grid.
    pub linearity: Option<Linearity>,
    /// Mean mechanical power into the sheet over the drive or its last period, in W; `None` where
    /// [`power()`] cannot determine it.
    pub power: Option<f64>,
    /// Sound above the surface; `None` from [`judge()`], which knows no listener.
    pub sound: Option<Sound>,
    /// Warnings, such as where linear theory no longer holds.
    pub notes: Vec<Note>,
}

/// Evaluates the field of a drive at the places and instants `aims`; `period` is that of a repeated drive,
/// in seconds. Traces last until `until` seconds, or as long as the field is known.
///
/// # Errors
/// Those of [`Field::measure`] and [`Field::traces`].
pub fn judge(
    surface: &Surface,
    field: &Field,
    aims: &[Aim],
    period: Option<f64>,
    until: f64,
) -> Result<Judged, ActError> {
    let until = until.min(known(field));
    let measured = field.measure(aims, period)?;
    let first: Vec<Point> = aims.iter().filter_map(|aim| aim.points.first().copied()).collect();
    let traces = field.traces(&first, until)?;
    let reach = Reach::of(&measured);
    let found = linear(surface, &reach);
    let notes = note::all(surface, &measured, reach.displacement, &found);
    let linearity = reach.steepness.map(|_| found);
    let power = power(surface, field, measured.drive.duration_s)?;
    Ok(Judged { measured, traces, until, linearity, power, sound: None, notes })
}

/// The last instant at which a field is known, in seconds.
pub fn known(field: &Field) -> f64 {
    field.known().saturating_sub(1) as f64 / field.rate()
}

/// Measures of how large the deflections of a field are for linear theory. Without slopes, displacement
/// alone counts.
pub(super) fn linear(surface: &Surface, reach: &Reach) -> Linearity {
    let steep = reach.steepness.unwrap_or_default();
    linearity(surface, reach.displacement, steep.slope, steep.mean_square_slope, steep.curvature)
}
