//! Folders of results: built beside their final place, and moved there in one step.

use crate::record::{Record, Request};
use crate::{Progress, TaskError};
use serde::Serialize;
use std::path::Path;
use unripple_store::OutputDir;

/// Begins an output folder, built beside its final `place`, and the record of the run that fills it; `None`
/// without a place. The folder must not replace a file or folder that the request reads.
///
/// # Errors
/// Those of [`OutputDir::create_beside`] and [`Record::of`].
pub fn begin<A: Request>(place: Option<&Path>, ask: &A) -> Result<Option<(OutputDir, Record)>, TaskError> {
    place.map(|place| Ok((OutputDir::create_beside(place, &ask.reads())?, Record::of(ask)?))).transpose()
}

/// Moves an output folder to its final place unless the task is cancelled, and tells `progress` its path
/// and whether it replaced an earlier run.
///
/// # Errors
/// [`TaskError::Cancelled`]; those of [`OutputDir::commit`].
pub fn finish(out: OutputDir, progress: &mut dyn Progress) -> Result<(), TaskError> {
    let (mut out, mut committed) = (Some(out), None);
    progress.place(&mut || {
        if let Some(out) = out.take() {
            committed = Some(out.commit()?);
        }
        Ok(())
    })?;
    if let Some(committed) = committed {
        if committed.replaced {
            progress.tell(&format!("replaced the earlier run in {}", committed.path.display()));
        }
        progress.tell(&format!("wrote {}", committed.path.display()));
    }
    Ok(())
}

/// Converts a report to indented JSON.
///
/// # Errors
/// [`TaskError::Work`] of what JSON cannot hold.
pub fn json(report: &impl Serialize) -> Result<String, TaskError> {
    serde_json::to_string_pretty(report).map_err(TaskError::work)
}
