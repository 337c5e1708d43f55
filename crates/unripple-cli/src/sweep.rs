//! `unripple sweep`: many designs for one task, in shards that survive any kill.

use crate::args::SweepOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::progress::Terminal;
use crate::{interrupt, output};
use std::path::{Path, PathBuf};
use std::process::Command;
use unripple_tasks::observed;
use unripple_tasks::sweep::{self, Ask, Piece, Workers};

/// Computes a plan by several processes of this program, one shard of it in this process, or, if this process was started by
/// a sweep, the part assigned to it.
pub fn run(options: &SweepOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let ask = Ask {
        plan: options.plan.clone(),
        output: options.output.clone(),
        shard: options.shard,
        count: options.count,
        no_figures: options.no_figures,
        columns: options.columns,
    };
    if let Some(piece) = &options.piece {
        let piece = piece.parse::<Piece>().map_err(|why| CliError::Input(format!("--piece: {why}")))?;
        interrupt::end_when_input_ends()?;
        return Ok(observed(&mut Terminal::default(), |progress| sweep::compute(&ask, piece, progress))?);
    }
    let program = crew(options.jobs)?;
    let record = output::record(common.json, &ask)?;
    let place = ask.output.clone().unwrap_or_default();
    let command = |piece| command(program.as_deref(), &ask.plan, &place, piece);
    let workers = Workers { jobs: options.jobs, command: &command };
    let workers = program.is_some().then_some(&workers);
    let done = observed(&mut Terminal::default(), |progress| sweep::run_with(&ask, workers, progress));
    output::recorded(&done?, record.as_ref())
}

/// This program, to be started again as so many processes; `None` where it is part of another, as within Python.
pub fn crew(jobs: usize) -> Result<Option<PathBuf>, CliError> {
    let program = own_program();
    if jobs == 0 || jobs > 1 && program.is_none() {
        let expected = if program.is_some() { "at least 1" } else { "1 within another program" };
        return Err(CliError::Input(format!("--jobs: expected {expected}, found {jobs}")));
    }
    Ok(program)
}

/// The path of this program; `None` where it is part of another.
fn own_program() -> Option<PathBuf> {
    let program = std::env::current_exe().ok()?;
    let name = program.file_stem()?.to_string_lossy().into_owned();
    name.starts_with("unripple").then_some(program)
}

/// The command of a process of `program` that computes a piece of a plan into a folder.
pub fn command(program: Option<&Path>, plan: &Path, place: &Path, piece: Piece) -> Command {
    let mut command = Command::new(program.unwrap_or(Path::new("unripple")));
    command.args(piece.arguments(plan, place));
    command
}
