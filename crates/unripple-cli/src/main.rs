//! `unripple`: time-reversed focusing of touch, from the command line.

/// As that of the standard library, but a reader of standard error that has gone away, as in `2>&1 | head`, is no reason to panic.
macro_rules! eprintln {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($text)*);
    }};
}

mod args;
mod calibrate;
mod check;
mod common;
mod compare;
mod config;
mod design;
mod devices;
mod doctor;
mod drift;
mod error;
mod export;
mod field;
mod fit;
mod focus;
mod interrupt;
mod lines;
mod materials;
mod modes;
mod options;
mod output;
mod play;
mod progress;
mod reproduce;
mod rerun;
mod respond;
mod shell;
mod targets;
mod view;
mod waveforms;

use args::{Arguments, Command};
use common::Common;
use error::CliError;
use lines::Talk;
use std::process::ExitCode;

fn main() -> ExitCode {
    unripple_tasks::record::built_from(env!("UNRIPPLE_COMMIT"));
    let (arguments, added) = match config::arguments() {
        Ok(found) => found,
        Err(error) => return error.report(),
    };
    lines::settle(match (arguments.verbose, arguments.quiet) {
        (true, _) => Talk::Verbose,
        (_, true) => Talk::Quiet,
        _ => Talk::Usual,
    });
    if let Some(added) = added.filter(|_| arguments.verbose) {
        eprintln!("{added}");
    }
    match interrupt::watch().and_then(|()| run(&arguments)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            if matches!(error, CliError::Cancelled) {
                interrupt::end_as_wished();
            }
            error.report()
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), CliError> {
    let common = &Common::of(arguments)?;
    match &arguments.command {
        Command::Calibrate(options) => calibrate::run(options, common),
        Command::Export(options) => export::run(options, common),
        Command::Fit(options) => fit::run(options, common),
        Command::Check(options) => check::run(options, common),
        Command::Design(options) => design::run(options, common),
        Command::Modes(options) => modes::run(options, common),
        Command::Respond(options) => respond::run(options, common),
        Command::Focus(options) => focus::run(options, common),
        Command::Compare(options) => compare::run(options, common),
        Command::Field(options) => field::run(options, common),
        Command::Play(options) => play::run(options, common),
        Command::View(options) => view::run(options, common),
        Command::Materials(options) => materials::run(options, common),
        Command::Devices(options) => devices::run(options, common),
        Command::Doctor(options) => doctor::run(options, common),
        Command::Drift(options) => drift::run(options, common),
        Command::Reproduce(options) => reproduce::run(options, common),
        Command::Rerun(options) => rerun::run(options, common),
        Command::Completions(options) => shell::completions(options, common),
        Command::Man(options) => shell::man(options, common),
    }
}
