//! Checks a surface file for faults.

use super::{Ask, Costs, Report};
use crate::cost::{self, Estimate};
use crate::curves::flattened;
use crate::{Progress, TaskError, go_on, machine};
use unripple::act::model_cost;
use unripple::core::Surface;

/// Lists all faults of a surface file. Faults are the result of this task, not an error.
///
/// # Errors
/// [`TaskError::Input`] if there is no surface of that name, or its file cannot be read.
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    go_on(progress)?;
    let surface = ask.surface.to_string();
    match ask.surface.load() {
        Ok(found) => {
            let notes = flattened(&found).into_iter().collect();
            let costs = Some(costs(&found));
            let named = Some((found.name, found.actuators.len()));
            Ok(Report {
                surface,
                ok: true,
                faults: Vec::new(),
                omitted: None,
                notes,
                costs,
                file: None,
                named,
            })
        }
        Err(TaskError::Faults(file)) => Ok(Report {
            surface,
            ok: false,
            faults: file.faults().to_vec(),
            omitted: Some(file.omitted()),
            notes: Vec::new(),
            costs: None,
            file: Some(file),
            named: None,
        }),
        Err(error) => Err(error),
    }
}

/// What tasks on a surface cost, within the memory of this machine; the reason where its modes cannot be had.
fn costs(surface: &Surface) -> Result<Costs, String> {
    machine::memory().during(|| {
        let told = |error| TaskError::from(error).to_string();
        let modes = Estimate::of(model_cost(surface, None, &[]).map_err(told)?);
        let focus =
            cost::of_drives(surface, surface, None, None, &[], 1).map_err(|error| error.to_string())?;
        Ok(Costs { modes, focus: Estimate::of(focus) })
    })
}
