//! Standard output: one JSON object, or text for people.

use crate::error::CliError;
use crate::options;
use crate::progress::Terminal;
use std::io::Write;
use unripple_tasks::record::Request;
use unripple_tasks::{Progress, Record, Report, TaskError, folder, observed};

/// Writes bytes to standard output. A reader that has gone away, as in `unripple … | head`, is no failure.
pub fn print(bytes: &[u8]) -> Result<(), CliError> {
    match std::io::stdout().lock().write_all(bytes) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(CliError::work(error)),
        _ => Ok(()),
    }
}

/// Runs a task while its progress is shown, and prints its report after the progress bar is removed.
pub fn perform<A: Request, R: Report>(
    as_json: bool,
    ask: &A,
    run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>,
) -> Result<(), CliError> {
    let record = record(as_json, ask)?;
    let done = observed(&mut Terminal::default(), |progress| run(ask, progress));
    recorded(&done?, record.as_ref())
}

/// The record of a task that is about to run; `None` unless the report is printed as JSON, since to hash
/// large input files takes time.
pub fn record(as_json: bool, ask: &impl Request) -> Result<Option<Record>, CliError> {
    Ok(as_json.then(|| Record::of(ask)).transpose()?)
}

/// Prints the report of a task, with a record as one JSON object, and fails if the task counts as failed.
pub fn recorded(report: &impl Report, record: Option<&Record>) -> Result<(), CliError> {
    let text = record.map_or_else(|| Ok(report.text()), |record| record.json(report))?;
    say(&text)?;
    failure(report)
}

/// Prints the report of a task that holds its record itself, and fails if the task counts as failed.
pub fn report(as_json: bool, report: &impl Report) -> Result<(), CliError> {
    let text = if as_json { folder::json(report)? } else { report.text() };
    say(&text)?;
    failure(report)
}

/// Prints text, with the names of a request's fields replaced by those of options.
fn say(text: &str) -> Result<(), CliError> {
    print(format!("{}\n", options::spoken(text.trim_end())).as_bytes())
}

fn failure(report: &impl Report) -> Result<(), CliError> {
    report.failure().map_or(Ok(()), |why| Err(CliError::Work(options::spoken(&why))))
}
