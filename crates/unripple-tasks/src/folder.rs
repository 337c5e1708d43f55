//! Folders of results: made beside their place, and put there in one step.

use crate::record::{Record, Request};
use crate::{Progress, TaskError};
use serde::Serialize;
use std::path::Path;
use unripple_store::OutputDir;

/// An output folder under construction beside its place, if there is one, and the record of what is about to fill it. It replaces no
/// file or folder that the request reads.
///
/// # Errors
/// Those of [`OutputDir::create_beside`] and [`Record::of`].
pub fn begin<A: Request>(place: Option<&Path>, ask: &A) -> Result<Option<(OutputDir, Record)>, TaskError> {
    place.map(|place| Ok((OutputDir::create_beside(place, &ask.reads())?, Record::of(ask)?))).transpose()
}

/// Puts an output folder in its place unless the task is cancelled, and says so if it replaced an earlier run's.
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

/// A report as indented JSON.
///
/// # Errors
/// [`TaskError::Work`] of what JSON cannot hold.
pub fn json(report: &impl Serialize) -> Result<String, TaskError> {
    serde_json::to_string_pretty(report).map_err(TaskError::work)
}
