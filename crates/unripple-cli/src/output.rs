//! Standard output: one JSON object, or text for people.

use crate::error::CliError;
use crate::options;
use crate::progress::Terminal;
use serde::Serialize;
use std::io::Write;
use unripple_tasks::{Progress, Report, TaskError, folder};

/// Prints `report` as one JSON object, or `text`, in the words of the command line.
///
/// A reader that has gone away, as in `unripple … | head`, is no failure.
pub fn answer(as_json: bool, report: &impl Serialize, text: &str) -> Result<(), CliError> {
    let mut line = options::spoken(&if as_json { folder::json(report)? } else { text.trim_end().to_owned() });
    line.push('\n');
    print(line.as_bytes())
}

/// Writes bytes to standard output. A reader that has gone away, as in `unripple … | head`, is no failure.
pub fn print(bytes: &[u8]) -> Result<(), CliError> {
    match std::io::stdout().lock().write_all(bytes) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(CliError::work(error)),
        _ => Ok(()),
    }
}

/// Does a task before people's eyes, and prints its report once nothing else is drawn there.
pub fn perform<A, R: Report>(
    as_json: bool,
    ask: &A,
    run: fn(&A, &mut dyn Progress) -> Result<R, TaskError>,
) -> Result<(), CliError> {
    let done = run(ask, &mut Terminal::default());
    report(as_json, &done?)
}

/// Prints the report of a task, and fails if the task counts as failed.
pub fn report(as_json: bool, report: &impl Report) -> Result<(), CliError> {
    answer(as_json, report, &report.text())?;
    report.failure().map_or(Ok(()), |why| Err(CliError::Work(options::spoken(&why))))
}
