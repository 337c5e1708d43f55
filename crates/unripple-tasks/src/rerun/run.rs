//! Reading a report's record, and doing what it records.

use super::{Ask, Report};
use crate::record::{Record, Request};
use crate::{Progress, TaskError, go_on};
use crate::{
    calibrate, check, compare, design, devices, doctor, drift, export, field, fit, focus, materials, modes,
    play, respond, stroke, waveform,
};
use serde::Deserialize;
use std::path::PathBuf;

/// A report, of which only the record is read.
#[derive(Deserialize)]
struct Recorded {
    run: Record,
}

/// Does the run of a report once more: with the options, seeds and surfaces that it had, on the files that it read, which must not have
/// changed.
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

/// Does what a record holds once more; `ask` says which report it is from, and where results go.
///
/// # Errors
/// [`TaskError::Input`] of a command that is no task; those of [`again`].
pub fn repeat(record: &Record, ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let to = ask.output.clone();
    match record.command.as_str() {
        check::Ask::COMMAND => again(record, to, check::run, progress),
        design::Ask::COMMAND => again(record, to, design::run, progress),
        modes::Ask::COMMAND => again(record, to, modes::run, progress),
        materials::Ask::COMMAND => again(record, to, materials::run, progress),
        focus::Ask::COMMAND => again(record, to, focus::run, progress),
        waveform::Ask::COMMAND => again(record, to, waveform::run, progress),
        stroke::Ask::COMMAND => again(record, to, stroke::run, progress),
        field::Ask::COMMAND => again(record, to, field::run, progress),
        compare::Ask::COMMAND => again(record, to, compare::run, progress),
        respond::Ask::COMMAND => again(record, to, respond::run, progress),
        calibrate::Ask::COMMAND => again(record, to, calibrate::run, progress),
        fit::Ask::COMMAND => again(record, to, fit::run, progress),
        export::Ask::COMMAND => again(record, to, export::run, progress),
        drift::Ask::COMMAND => again(record, to, drift::run, progress),
        doctor::Ask::COMMAND => again(record, to, doctor::run, progress),
        devices::Ask::COMMAND => again(record, to, devices::run, progress),
        play::Ask::COMMAND => again(record, to, play::run, progress),
        other => Err(TaskError::Input(format!(
            "{}: expected a command that can be repeated, found `{other}`",
            ask.report.display()
        ))),
    }
}

/// The record that a report holds.
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

/// Does what a record holds once more with its results sent elsewhere.
///
/// # Errors
/// Those of [`Record::ask`] and of the command.
pub fn again<A: Request, R: crate::Report>(
    record: &Record,
    output: Option<PathBuf>,
    run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    let mut ask: A = record.ask()?;
    ask.send_to(output);
    let new = Record { surfaces: record.surfaces.clone(), ..Record::of(&ask)? };
    let report = run(&ask, progress)?;
    Report::of(&report, new.json(&report)?)
}
