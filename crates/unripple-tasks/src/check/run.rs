//! Checks a surface file for faults.

use super::{Ask, Report};
use crate::curves::flattened;
use crate::{Progress, TaskError, go_on};

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
            let named = Some((found.name, found.actuators.len()));
            Ok(Report { surface, ok: true, faults: Vec::new(), omitted: None, notes, file: None, named })
        }
        Err(TaskError::Faults(file)) => Ok(Report {
            surface,
            ok: false,
            faults: file.faults().to_vec(),
            omitted: Some(file.omitted()),
            notes: Vec::new(),
            file: Some(file),
            named: None,
        }),
        Err(error) => Err(error),
    }
}
