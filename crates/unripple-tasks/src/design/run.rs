//! Computes the design tradeoffs of a surface.

use super::{Ask, Report};
use crate::{Progress, TaskError, cost, go_on};
use unripple::act;

/// Computes the design figures of a surface: wave speeds, modes, window, predicted contrast, spot size,
/// power at the finger.
///
/// # Errors
/// Those of [`SurfaceAsk::load`](crate::SurfaceAsk::load); [`TaskError::Input`] where a figure has no closed form;
/// [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    go_on(progress)?;
    // Where modes are out of reach, the figures are those of laws.
    if let Ok(model) = act::model_cost(&surface, None, &[]) {
        let less = "a lower top of the band or a coarser `accuracy`";
        cost::announce(model + act::window_cost(&surface), less, progress);
    }
    progress.stage("modes and window");
    unripple::physics::design(&surface).map_err(TaskError::input)
}
