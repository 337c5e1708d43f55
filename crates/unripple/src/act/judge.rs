use super::note::{self, Note};
use super::{ActError, note::largest};
use crate::core::{Point, Surface};
use crate::field::{Aim, Field, Measured, Steepness, Trace};
use crate::physics::design::{Linearity, linearity};

/// Cells of the grid per shortest wavelength that figures are taken on.
pub const CELLS: f64 = 8.0;

/// What a drive was found to do.
#[derive(Clone, Debug)]
pub struct Judged {
    /// All figures and maps.
    pub measured: Measured,
    /// How each target moves, from the drive's first sample on; of a set, its first point.
    pub traces: Vec<Trace>,
    /// How far the traces go, in seconds.
    pub until: f64,
    /// How far from small the deflections are; `None` on a library's own points.
    pub linearity: Option<Linearity>,
    /// What linear theory cannot say, and other warnings.
    pub notes: Vec<Note>,
}

/// Measures what the field of a drive is at the aims; `period` in seconds, of a repeated drive. Traces last until `until`
/// seconds, or as long as the field is known.
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
    let linearity = small(surface, &measured);
    let notes = note::all(surface, &measured, linearity.as_ref());
    Ok(Judged { measured, traces, until, linearity, notes })
}

/// The last instant at which a field is known, in seconds.
pub fn known(field: &Field) -> f64 {
    field.known().saturating_sub(1) as f64 / field.rate()
}

/// How far from small the deflections are. Slopes are known where targets are at their extreme; elsewhere the surface is
/// calmer, and what is more there is allowed for in proportion to the displacement.
fn small(surface: &Surface, measured: &Measured) -> Option<Linearity> {
    let steep = Steepness::of(&measured.maps)?;
    let largest = largest(measured);
    let taken = measured.maps.at_displacement_peak.iter().flat_map(|s| &s.displacement);
    let taken = taken.fold(0.0, |m: f64, u| m.max(f64::from(u.abs())));
    let more = if taken > 0.0 { (largest / taken).max(1.0) } else { 1.0 };
    let (slope, square) = (steep.slope * more, steep.mean_square_slope * more * more);
    Some(linearity(surface, largest, slope, square, steep.curvature * more))
}
