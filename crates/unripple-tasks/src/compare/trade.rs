//! Quantities that focusing methods trade for each other: contrast, energy and peak at the first target.

use super::ground::Ground;
use crate::TaskError;
use unripple::focus::Focused;

/// Contrast, drive energy per squared peak velocity, and peak velocity at the first target.
pub(super) type Trade = [f64; 3];

/// Contrast, energy per squared peak, and peak of a drive, at the first target and its focal instant.
pub(super) fn traded(ground: &Ground<'_>, focused: &Focused) -> Result<Trade, TaskError> {
    let drive = focused.drive.clone().as_emitted();
    let field = ground.on.coarse()?.field(&drive).map_err(TaskError::input)?;
    let places: Vec<_> = ground.targets.iter().flat_map(|target| target.points.iter().copied()).collect();
    let found =
        field.at_instant(focused.instant(), &ground.targets[0].points, &places).map_err(TaskError::input)?;
    let peak = found.velocity.abs();
    Ok([peak / found.rms_outside, drive.energy() / (peak * peak), peak])
}
