//! Errors of commands, and their exit statuses: 1 the work failed, 2 bad usage or bad input.

use crate::options;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use unripple_tasks::TaskError;

/// Error that ended a command.
#[derive(Debug)]
pub enum CliError {
    /// An input, or a combination of inputs, is not accepted: exit status 2.
    Input(String),
    /// A file has faults, each with its line and column: exit status 2.
    Faults(Box<dyn Diagnostic + Send + Sync>),
    /// The work failed: exit status 1.
    Work(String),
    /// The task was cancelled before there was a result: the program ends as the signal that cancelled it would have ended it.
    Cancelled,
    /// The command line is a request for help (exit status 0), or cannot be understood (2).
    Usage(clap::Error),
}

impl From<clap::Error> for CliError {
    fn from(error: clap::Error) -> Self {
        Self::Usage(error)
    }
}

impl From<TaskError> for CliError {
    fn from(error: TaskError) -> Self {
        match error {
            TaskError::Ask { field, expected, found } => {
                let expected = options::spoken(&expected);
                Self::Input(format!("{}: expected {expected}, found {found}", options::option(field)))
            }
            TaskError::Input(text) | TaskError::Memory(text) => Self::Input(options::spoken(&text)),
            TaskError::Faults(faults) => Self::Faults(faults),
            TaskError::Work(text) => Self::Work(options::spoken(&text)),
            TaskError::Cancelled => Self::Cancelled,
        }
    }
}

impl std::fmt::Display for CliError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Input(text) | Self::Work(text) => f.write_str(text),
            Self::Faults(faults) => write!(f, "{faults:#}"),
            Self::Cancelled => f.write_str("stopped before it was done"),
            Self::Usage(error) => write!(f, "{error}"),
        }
    }
}

impl CliError {
    /// Error of a computation or an output that failed, from its message.
    pub fn work(error: impl std::fmt::Display) -> Self {
        Self::Work(error.to_string())
    }

    /// Prints the error on standard error, or the help that was asked for on standard output, and returns the exit status.
    pub fn report(&self) -> u8 {
        match self {
            Self::Input(_) | Self::Work(_) | Self::Cancelled => eprintln!("error: {self}"),
            Self::Faults(faults) => eprintln!("{}", rendered(faults.as_ref()).trim_end_matches('\n')),
            // A reader that has gone away is no failure.
            Self::Usage(error) => _ = error.print(),
        }
        match self {
            Self::Usage(error) if !error.use_stderr() => 0,
            Self::Work(_) | Self::Cancelled => 1,
            Self::Input(_) | Self::Faults(_) | Self::Usage(_) => 2,
        }
    }
}

/// A diagnostic with its source lines and carets, in colour only on a terminal that wants it.
fn rendered(faults: &dyn Diagnostic) -> String {
    use std::io::IsTerminal;
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let mut text = String::new();
    match GraphicalReportHandler::new_themed(theme).with_width(110).render_report(&mut text, faults) {
        Ok(()) => text,
        Err(_) => format!("error: {faults}\n"),
    }
}
