//! `unripple optimise`: the designs whose figures are most or least, found generation by generation.

use crate::args::OptimiseOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use crate::sweep::{command, crew};
use std::path::Path;
use unripple_tasks::observed;
use unripple_tasks::optimise::{self, ByPython, Crew};
use unripple_tasks::sweep::Piece;

/// Searches by a plan: the Python package asks for designs, and processes of this program compute them.
pub fn run(options: &OptimiseOptions, common: &Common) -> Result<(), CliError> {
    let ask = options.ask(common)?;
    let program = crew(options.jobs)?;
    let record = output::record(common.json, &ask)?;
    let start = |plan: &Path, place: &Path, piece: Piece| command(program.as_deref(), plan, place, piece);
    let crew = Crew { jobs: options.jobs, command: &start };
    let crew = program.is_some().then_some(&crew);
    let asker = ByPython::default();
    let done =
        observed(&mut Terminal::default(), |progress| optimise::run_with(&ask, &asker, crew, progress));
    output::recorded(&done?, record.as_ref())
}
