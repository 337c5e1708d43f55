//! Checks of a request for a focus, made before any long computation.

use super::Ask;
use super::run::settings;
use crate::figures::Columns;
use crate::numbers::above_zero;
use crate::target::targets;
use crate::window::{carries, conditions};
use crate::{TaskError, fingers, judge};
use unripple::act::ActError;
use unripple::core::Surface;
use unripple::focus::{FocusError, Options, Target};
use unripple::physics::Medium;

/// Checks a request and its surface before any mode is computed, and returns an error for values that make
/// no sense.
///
/// ```
/// use unripple_tasks::target::PointAsk;
/// use unripple_tasks::{SurfaceAsk, focus};
///
/// let film = SurfaceAsk::default().load()?;
/// let ask = focus::Ask { points: vec![PointAsk::at(0.3, 0.09)], ..focus::Ask::default() };
/// assert!(focus::check(&ask, &film).is_err_and(|error| error.to_string().contains("outside the surface")));
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// Those of [`run`](super::run()) that need neither modes nor a drive.
pub fn check(ask: &Ask, surface: &Surface) -> Result<(), TaskError> {
    Columns::of(ask.columns)?;
    let plant = ask.on.as_ref().map(|on| on.load()).transpose()?;
    let lambda_min = Medium::of(&surface.sheet).lambda_min(surface.emission.band[1]);
    let targets = targets(&ask.points, &ask.shapes, lambda_min)?;
    ask.level.level()?;
    lasts(ask, surface)?;
    possible(ask, surface, plant.as_ref().unwrap_or(surface), &targets)
}

/// Returns an error for a requested window that no wave of the surface's band fits into.
pub(super) fn lasts(ask: &Ask, surface: &Surface) -> Result<(), TaskError> {
    let window = ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()?;
    window.map_or(Ok(()), |window| carries(&conditions(surface), window, "window_s"))
}

/// Checks targets, options and fingers on the surface that the drive is computed for and on `plant`, the
/// surface that it is evaluated on.
pub(super) fn possible(
    ask: &Ask,
    surface: &Surface,
    plant: &Surface,
    targets: &[Target],
) -> Result<(), TaskError> {
    let refused = |error: FocusError| TaskError::from(ActError::from(error));
    Target::check(targets, &surface.outline).map_err(refused)?;
    judge::reaches(plant, ask.judge_hz)?;
    judge::listening(ask.listen_m)?;
    let window = ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()?;
    // Where no window is given, any that makes sense stands for the one that will be chosen.
    settings(ask, surface, window.unwrap_or(Options::default().window))?.check().map_err(refused)?;
    if ask.finger_aware && ask.fingers_m.is_empty() {
        return Err(TaskError::ask("finger_aware", "`fingers_m` with it", "none"));
    }
    if let Some(share) = ask.bear_tension
        && !(share > 0.0 && share < 0.5)
    {
        return Err(TaskError::ask("bear_tension", "a share above 0 and below 0.5", share));
    }
    for sheet in [surface, plant] {
        fingers::contacts(&ask.fingers_m, "fingers_m", sheet)?;
    }
    fingers::contacts(&ask.bear_fingers_m, "bear_fingers_m", surface).map(drop)
}
