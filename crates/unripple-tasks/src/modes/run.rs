//! Modal analysis of a surface.

use super::{Ask, Loaded, Report};
use crate::curves::flattened;
use crate::numbers::above_zero;
use crate::{Progress, TaskError, cost, go_on};
use unripple::act::less_accurate;
use unripple::core::ModeError;
use unripple::physics::{Accuracy, SurfaceModes};

/// Default relative accuracy, if it can be reached: a phase error of 1e-3 rad at 3 kHz after 50 ms. With a
/// smaller value, modes that need a mesh take minutes.
const ACCURACY: f64 = 1e-6;

/// Computes the modes of a surface up to a frequency, for the sheet alone and with its actuators.
///
/// # Errors
/// Those of [`SurfaceAsk::load`](crate::SurfaceAsk::load); [`TaskError::Ask`] if the frequency is not above 0; [`TaskError::Memory`] and
/// [`TaskError::Input`] where modes cannot be had.
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    let top = above_zero(ask.top_hz.unwrap_or(surface.emission.band[1]), "top_hz", "Hz")?;
    let accuracy = Accuracy::of(ask.accuracy.or(surface.accuracy), ACCURACY);
    go_on(progress)?;
    let cost = SurfaceModes::cost(&surface, top, accuracy)?;
    cost::announce(cost, "a lower top frequency or a coarser `accuracy`", progress);
    progress.stage("modes");
    let modes = SurfaceModes::solve(&surface, top, accuracy)?;
    let sheet = Loaded::of(&modes.sheet);
    let of_decay = |(decay, error): (&Option<f64>, &ModeError)| decay.and(error.decay);
    let decay_errors = sheet.decay_times_s.iter().zip(&modes.errors).map(of_decay).collect();
    Ok(Report {
        surface: surface.name.clone(),
        max_hz: top,
        count: sheet.count,
        frequencies_hz: sheet.frequencies_hz,
        decay_times_s: sheet.decay_times_s,
        relative_error: modes.error,
        decay_errors,
        loaded: modes.loaded.as_deref().map(Loaded::of),
        notes: flattened(&surface).into_iter().chain(less_accurate(modes.error, accuracy.aim)).collect(),
        bending_shares: modes.bending_shares,
    })
}
