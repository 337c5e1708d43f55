//! Reads the record in a report, and repeats the run that it describes.

use super::{Ask, Report};
use crate::commands::{again, find};
use crate::record::{Record, Request};
use crate::{Progress, TaskError, go_on, optimise, sweep};
use serde::Deserialize;

/// The part of a report that is read: the record of its run.
#[derive(Deserialize)]
struct Recorded {
    run: Record,
}

/// Repeats the run that made a report, with the recorded options, seeds and surfaces, on the files that the
/// run read, which must not have changed.
///
/// ```
/// use unripple_tasks::{Record, Silent, modes, rerun};
///
/// let file = std::env::temp_dir().join(format!("unripple-doc-{}.json", std::process::id()));
/// let ask = modes::Ask { top_hz: Some(300.0), ..modes::Ask::default() };
/// let report = modes::run(&ask, &mut Silent)?;
/// std::fs::write(&file, Record::of(&ask)?.json(&report)?)?;
/// let again = rerun::run(&rerun::Ask { report: file.clone(), output: None }, &mut Silent)?;
/// assert!(again.text.contains("modes up to 300 Hz"));
/// # std::fs::remove_file(file)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`TaskError::Input`] of a file without a record, of one that the run read and that is gone or has changed; those of the command.
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    go_on(progress)?;
    repeat(&record(ask)?, ask, progress)
}

/// Repeats a recorded run; `ask` names the report that the record is from and where results are written.
///
/// # Errors
/// [`TaskError::Input`] of a command that is no task; those of [`Record::ask`] and of the command.
pub fn repeat(record: &Record, ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    match find(&record.command) {
        Some(task) => Report::of((task.again)(record, ask.output.clone(), progress)?),
        None if record.command == sweep::Ask::COMMAND => {
            Report::of(again(record, ask.output.clone(), sweep::run, progress)?)
        }
        None if record.command == optimise::Ask::COMMAND => {
            Report::of(again(record, ask.output.clone(), optimise::run, progress)?)
        }
        None => Err(TaskError::Input(format!(
            "{}: expected a command that can be repeated, found `{}`",
            ask.report.display(),
            record.command
        ))),
    }
}

/// Reads the record of the run from a report's file.
///
/// # Errors
/// [`TaskError::Input`] of a file that cannot be read or holds none.
pub fn record(ask: &Ask) -> Result<Record, TaskError> {
    let path = ask.report.display();
    let text = std::fs::read_to_string(&ask.report)
        .map_err(|error| TaskError::Input(format!("{path}: expected a report.json, found {error}")))?;
    let report: Recorded = serde_json::from_str(&text).map_err(|error| {
        TaskError::Input(format!(
            "{path}: expected a report that records its run under \"run\", found {error}"
        ))
    })?;
    Ok(report.run)
}
