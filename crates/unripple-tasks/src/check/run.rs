//! Checks a surface file for faults.

use super::{Ask, Costs, Report};
use crate::cost::{self, Estimate};
use crate::curves::flattened;
use crate::{Progress, TaskError, go_on};
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
            let costs = costs(&found);
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

/// What tasks on a surface cost; `None` where its modes cannot be had.
fn costs(surface: &Surface) -> Option<Costs> {
    let modes = Estimate::of(model_cost(surface, None, &[]).ok()?);
    let focus = Estimate::of(cost::of_drives(surface, None, None, &[], 1).ok()?);
    Some(Costs { modes, focus })
}
