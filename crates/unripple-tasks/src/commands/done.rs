//! Runs a task from a request as JSON to a report as JSON.

use crate::record::{Record, Request, asked};
use crate::{Progress, Report, SurfaceAsk, TaskError, folder};
use serde_json::Value;
use std::path::PathBuf;

/// Result of a task: its report, as JSON for programs and as text for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Done {
    /// The report with the record of its run, as indented JSON.
    pub json: String,
    /// The report for people, as lines of text.
    pub text: String,
    /// Reason for which the task counts as failed although it has a report; `None` if it succeeded.
    pub failure: Option<String>,
}

impl Done {
    /// Converts a report to JSON and text; the JSON includes `record`, if there is one.
    ///
    /// # Errors
    /// [`TaskError::Work`] of what JSON cannot hold.
    pub fn of(report: &impl Report, record: Option<&Record>) -> Result<Self, TaskError> {
        let json = match record {
            Some(record) => record.json(report)?,
            None => folder::json(report)?,
        };
        Ok(Self { json, text: report.text(), failure: report.failure() })
    }
}

/// The default request of a task: all fields of its `Ask` with their default values, as JSON.
///
/// # Errors
/// [`TaskError::Work`] of what JSON cannot hold.
pub fn default_of<A: Request + Default>() -> Result<Value, TaskError> {
    serde_json::to_value(A::default()).map_err(TaskError::work)
}

/// What is made of each surface and each file that a request names.
pub(crate) trait Names {
    /// Names a surface, or any other source of responses, in another way.
    fn surface(&mut self, surface: &mut SurfaceAsk);

    /// Names another file in another way.
    fn file(&mut self, path: &mut PathBuf);
}

/// A request as JSON, with all its fields, and with surfaces and files renamed.
///
/// # Errors
/// Those of [`asked`].
pub(crate) fn renamed<A: Request>(ask: Value, names: &mut dyn Names) -> Result<Value, TaskError> {
    let mut ask: A = asked(ask)?;
    ask.surfaces().into_iter().for_each(|surface| names.surface(surface));
    ask.inputs(&mut |path| {
        names.file(path);
        Ok(())
    })?;
    serde_json::to_value(&ask).map_err(TaskError::work)
}

/// Performs the task `run`, with its request as JSON.
///
/// # Errors
/// Those of [`asked`], of [`Record::of`] and of the task.
pub fn perform<A: Request, R: Report>(
    ask: Value,
    run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>,
    progress: &mut dyn Progress,
) -> Result<Done, TaskError> {
    let ask: A = asked(ask)?;
    // Before the work, as the command line makes it: files may change meanwhile.
    let record = Record::of(&ask)?;
    Done::of(&run(&ask, progress)?, Some(&record))
}

/// Repeats a recorded run of the task `run`, with its results written to `output`.
///
/// # Errors
/// Those of [`Record::ask`] and of the task.
pub fn again<A: Request, R: Report>(
    record: &Record,
    output: Option<PathBuf>,
    run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>,
    progress: &mut dyn Progress,
) -> Result<Done, TaskError> {
    let mut ask: A = record.ask()?;
    ask.send_to(output);
    let new = Record { surfaces: record.surfaces.clone(), ..Record::of(&ask)? };
    Done::of(&run(&ask, progress)?, Some(&new))
}
