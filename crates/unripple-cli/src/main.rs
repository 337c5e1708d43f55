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
mod compare;
mod design;
mod devices;
mod doctor;
mod error;
mod export;
mod field;
mod fit;
mod focus;
mod interrupt;
mod modes;
mod options;
mod output;
mod play;
mod progress;
mod reproduce;
mod respond;
mod targets;
mod view;
mod waveforms;

use args::{Arguments, Command};
use clap::Parser;
use error::CliError;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match interrupt::watch().and_then(|()| run(&arguments)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => error.report(),
    }
}

fn run(arguments: &Arguments) -> Result<(), CliError> {
    let json = arguments.json;
    match &arguments.command {
        Command::Calibrate(options) => calibrate::run(options, json),
        Command::Export(options) => export::run(options, json),
        Command::Fit(options) => fit::run(options, json),
        Command::Check(options) => check::run(options, json),
        Command::Design(options) => design::run(options, json),
        Command::Modes(options) => modes::run(options, json),
        Command::Respond(options) => respond::run(options, json),
        Command::Focus(options) => focus::run(options, json),
        Command::Compare(options) => compare::run(options, json),
        Command::Field(options) => field::run(options, json),
        Command::Play(options) => play::run(options, json),
        Command::View(options) => view::run(options, json),
        Command::Devices(options) => devices::run(options, json),
        Command::Doctor(options) => doctor::run(options, json),
        Command::Reproduce(options) => reproduce::run(options, json),
    }
}
