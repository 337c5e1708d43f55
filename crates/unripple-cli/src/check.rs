//! `unripple check`: lists all faults of a surface file.

use crate::args::CheckOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::check::{self, Ask};

/// Lists the faults of a surface file, on standard error with their lines.
pub fn run(options: &CheckOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask { surface: common.surface(&options.surface) };
    let record = output::record(common.json, &ask)?;
    let checked = check::run(&ask, &mut Terminal::default());
    let mut report = checked?;
    // Faults are shown on standard error, with the lines that they are about.
    let faults = report.file.take();
    if common.json || faults.is_none() {
        output::recorded(&report, record.as_ref())?;
    }
    faults.map_or(Ok(()), |faults| Err(CliError::Faults(faults)))
}
