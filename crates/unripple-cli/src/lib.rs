//! The command line of Unripple, as a function: for the program `unripple`, and for whoever brings the program along, as a package of another
//! language does.

/// As that of the standard library, but a reader of standard error that has gone away, as in `2>&1 | head`, is no reason to panic.
macro_rules! eprintln {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($text)*);
    }};
}

mod args;
mod cache;
mod calibrate;
mod check;
mod common;
mod config;
mod error;
mod fit;
mod focus;
mod interrupt;
mod optimise;
mod options;
mod output;
mod play;
mod progress;
mod rerun;
mod shell;
mod sweep;
mod talk;
mod typed;
mod verify;
mod view;

use args::{Arguments, Command};
use common::Common;
use error::CliError;
use std::ffi::OsString;
use talk::Talk;
use unripple_paper::reproduce;
use unripple_tasks::{
    compare, design, devices, doctor, drift, export, field, import, listen, materials, modes, place, respond,
    sensors,
};

/// The commit that the program was built from; empty where that is not known.
pub const COMMIT: &str = env!("UNRIPPLE_COMMIT");

/// A hash of all sources that the program was built from; empty where that is not known.
pub const SOURCES: &str = env!("UNRIPPLE_SOURCES");

/// Runs the command of a command line, prints its results, and returns the exit code: 0, 1 or 2. The first argument is the program's own
/// name, as in [`std::env::args_os`]. To be called once in a process: it handles the signals that end the program, which end the process.
///
/// ```
/// use std::ffi::OsString;
///
/// assert_eq!(unripple_cli::command_line(["unripple", "--version"].map(OsString::from)), 0);
/// ```
pub fn command_line(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let given: Vec<OsString> = arguments.into_iter().collect();
    let code = match answer(&given) {
        Ok(()) => 0,
        Err(error) => {
            if matches!(error, CliError::Cancelled) {
                interrupt::end_as_wished();
            }
            error.report()
        }
    };
    // Programs in Rust do so when they end, others do not. A reader that has gone away is no failure.
    let _ = std::io::Write::flush(&mut std::io::stdout());
    code
}

fn answer(given: &[OsString]) -> Result<(), CliError> {
    unripple_tasks::record::built_from(COMMIT, SOURCES);
    let (arguments, added) = config::arguments(given)?;
    unripple_tasks::machine::asked().map_err(unripple_tasks::TaskError::Input)?;
    talk::settle(match (arguments.verbose, arguments.quiet) {
        (true, _) => Talk::Verbose,
        (_, true) => Talk::Quiet,
        _ => Talk::Usual,
    });
    if let Some(added) = added.filter(|_| arguments.verbose) {
        eprintln!("{added}");
    }
    interrupt::watch()?;
    run(&arguments)
}

fn run(arguments: &Arguments) -> Result<(), CliError> {
    let json = arguments.json;
    let common = &Common::of(json, &arguments.set, arguments.accuracy.as_deref())?;
    match &arguments.command {
        Command::Calibrate(options) => calibrate::run(options, common),
        Command::Import(options) => output::perform(json, &options.ask(common)?, import::run),
        Command::Export(options) => output::perform(json, &options.ask(common)?, export::run),
        Command::Fit(options) => fit::run(options, common),
        Command::Listen(options) => output::perform(json, &options.ask(common)?, listen::run),
        Command::Check(options) => check::run(options, common),
        Command::Design(options) => output::perform(json, &options.ask(common), design::run),
        Command::Modes(options) => output::perform(json, &options.ask(common), modes::run),
        Command::Place(options) => output::perform(json, &options.ask(common)?, place::run),
        Command::Sensors(options) => output::perform(json, &options.ask(common)?, sensors::run),
        Command::Respond(options) => output::perform(json, &options.ask(common)?, respond::run),
        Command::Focus(options) => focus::run(options, common),
        Command::Compare(options) => output::perform(json, &options.ask(common)?, compare::run),
        Command::Field(options) => output::perform(json, &options.ask(common)?, field::run),
        Command::Sweep(options) => sweep::run(options, common),
        Command::Optimise(options) => optimise::run(options, common),
        Command::Play(options) => play::run(options, common),
        Command::Verify(options) => verify::run(options, common),
        Command::View(options) => view::run(options, common),
        Command::Materials(options) => output::perform(json, &options.ask(common)?, materials::run),
        Command::Devices(options) => output::perform(json, &options.ask(common)?, devices::run),
        Command::Doctor(options) => output::perform(json, &options.ask(common), doctor::run),
        Command::Drift(options) => output::perform(json, &options.ask(common), drift::run),
        Command::Reproduce(options) => output::perform(json, &options.ask(common)?, reproduce::run),
        Command::Rerun(options) => rerun::run(options, common),
        Command::Cache(options) => cache::run(options, common),
        Command::Completions(options) => shell::completions(options, common),
        Command::Man(options) => shell::man(options, common),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_and_wrong_usage_return_their_codes() {
        let code = |line: &str| command_line(line.split(' ').map(OsString::from));
        assert_eq!(code("unripple --version"), 0);
        assert_eq!(code("unripple focus --no-such-option"), 2);
    }
}
