//! `unripple rerun`: an earlier run once more.

use crate::args::RerunOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_paper::commands;
use unripple_tasks::record::Request;
use unripple_tasks::rerun::{self, Ask};
use unripple_tasks::{observed, play};

/// Repeats the run that a report records.
pub fn run(options: &RerunOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let ask = Ask { report: options.report.clone(), output: options.output.clone() };
    let record = rerun::record(&ask)?;
    // What is played is ended by whoever listens; everything else may be interrupted.
    let mut terminal = match record.command.as_str() {
        play::Ask::COMMAND => Terminal::that_stops(),
        _ => Terminal::default(),
    };
    let done = observed(&mut terminal, |progress| commands::repeat(&record, &ask, progress));
    drop(terminal);
    output::report(common.json, &done?)
}
