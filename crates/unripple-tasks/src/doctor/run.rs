//! Checks of all stages between a touch and what is felt.

use super::{Ask, Check, Report, device, felt, touch};
use crate::{Progress, Solved, TaskError, go_on};
use std::sync::Arc;
use unripple::core::Surface;
use unripple_live::Window;

/// Checks each stage between a touch and what is felt. A stage that fails is part of the report, not an error.
///
/// # Errors
/// Those of [`SurfaceAsk::load`](crate::SurfaceAsk::load); [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    go_on(progress)?;
    progress.stage("window");
    let mut checks = vec![Check::good("surface", told(&surface))];
    let window = Window::prompt(&surface);
    go_on(progress)?;
    progress.stage("model");
    let solved = Solved::default();
    match solved.model(&surface, None, &[]) {
        Err(error) => checks.push(Check::failed(
            "model",
            error.to_string(),
            "the surface file describes something whose modes cannot be computed: `unripple modes` says more",
        )),
        Ok(model) => {
            let model = Arc::new(model);
            checks.push(Check::good("model", format!("{} responses are ready", surface.actuators.len())));
            go_on(progress)?;
            progress.stage("focus");
            checks.extend(felt::checks(&surface, &model, window, &solved)?);
            go_on(progress)?;
            progress.stage("device");
            checks.extend(device::checks(&ask.device, &surface, &model)?);
        }
    }
    checks.extend(touch::checks(ask));
    checks.push(device::priority());
    Ok(Report::of(surface.name, checks))
}

fn told(surface: &Surface) -> String {
    let (width, height) = surface.outline.extent();
    format!(
        "{}: {:.0} x {:.0} mm, {} actuators, {:.0} to {:.0} Hz",
        surface.name,
        width * 1e3,
        height * 1e3,
        surface.actuators.len(),
        surface.emission.band[0],
        surface.emission.band[1]
    )
}
