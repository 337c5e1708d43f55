//! `unripple rerun`: an earlier run once more.

use crate::args::RerunOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_paper::reproduce;
use unripple_tasks::play;
use unripple_tasks::record::Request;
use unripple_tasks::rerun::{self, Ask};

/// Does what a report records once more. The paper's page is above the tasks, so it is done here.
pub fn run(options: &RerunOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let ask = Ask { report: options.report.clone(), output: options.output.clone() };
    let record = rerun::record(&ask)?;
    // What is played is ended by whoever listens; everything else may be interrupted.
    let mut terminal = match record.command.as_str() {
        play::Ask::COMMAND => Terminal::that_stops(),
        _ => Terminal::default(),
    };
    let done = match record.command.as_str() {
        reproduce::Ask::COMMAND => rerun::again(&record, ask.output, reproduce::run, &mut terminal),
        _ => rerun::repeat(&record, &ask, &mut terminal),
    };
    drop(terminal);
    output::report(common.json, &done?)
}
