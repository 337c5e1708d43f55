//! How much the program prints on standard error while a task runs.

use std::io::{IsTerminal, stderr};
use std::sync::OnceLock;
use std::time::Instant;
use unripple_tasks::Lines;

/// Amount of progress output while a task runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Talk {
    /// Only warnings are printed.
    Quiet,
    /// A bar on a terminal; elsewhere lines on stages that take long.
    #[default]
    Usual,
    /// Each stage is printed as a line, with the time since the beginning.
    Verbose,
}

/// Set once for the whole program, since progress is reported from everywhere.
static TALK: OnceLock<Talk> = OnceLock::new();

/// Sets the amount of progress output; to be called once, before any task runs.
pub fn settle(talk: Talk) {
    // It is called once.
    let _ = TALK.set(talk);
}

/// Amount of progress output that was set.
pub fn talk() -> Talk {
    TALK.get().copied().unwrap_or_default()
}

/// Progress in lines if standard error is not a terminal, or with `--verbose`; otherwise `None`.
pub fn lines() -> Option<Lines> {
    let all = talk() == Talk::Verbose;
    let wanted = all || talk() == Talk::Usual && !stderr().is_terminal();
    wanted.then(|| Lines::new(Instant::now(), all))
}
