//! Performs a command by its name.

use super::done::{Done, default_of, perform};
use super::list::{TASKS, find};
use crate::record::{Request, asked};
use crate::{Progress, TaskError, optimise, rerun, sweep};
use serde_json::Value;

/// Names of the commands that [`run`] performs: all tasks, and `sweep`, `optimise` and `rerun`, which perform them.
pub const COMMANDS: [&str; TASKS.len() + 3] = {
    let mut names = [rerun::Ask::COMMAND; TASKS.len() + 3];
    names[TASKS.len()] = sweep::Ask::COMMAND;
    names[TASKS.len() + 1] = optimise::Ask::COMMAND;
    let mut at = 0;
    while at < TASKS.len() {
        names[at] = TASKS[at].name;
        at += 1;
    }
    names
};

/// The default request of a command: all its fields with their default values, as JSON.
///
/// # Errors
/// [`unknown`].
pub fn default_ask(command: &str) -> Result<Value, TaskError> {
    match find(command) {
        Some(task) => (task.default_ask)(),
        None if command == sweep::Ask::COMMAND => default_of::<sweep::Ask>(),
        None if command == optimise::Ask::COMMAND => default_of::<optimise::Ask>(),
        None if command == rerun::Ask::COMMAND => default_of::<rerun::Ask>(),
        None => Err(unknown(command, &COMMANDS)),
    }
}

/// Performs a command by its name; fields that are absent from the request `ask` get their defaults.
///
/// ```
/// use unripple_tasks::{Silent, commands};
///
/// let mut ask = commands::default_ask("modes")?;
/// ask["top_hz"] = 300.0.into();
/// let done = commands::run("modes", ask, &mut Silent)?;
/// assert!(done.text.contains("modes up to 300 Hz") && done.json.contains("\"command\": \"modes\""));
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`unknown`]; [`TaskError::Input`] of a request with a field that the command does not know, or a value that the field cannot have;
/// those of the command.
pub fn run(command: &str, ask: Value, progress: &mut dyn Progress) -> Result<Done, TaskError> {
    match find(command) {
        Some(task) => (task.run)(ask, progress),
        None if command == sweep::Ask::COMMAND => perform(ask, sweep::run, progress),
        None if command == optimise::Ask::COMMAND => perform(ask, optimise::run, progress),
        None if command == rerun::Ask::COMMAND => {
            Done::of(&rerun::run(&asked::<rerun::Ask>(ask)?, progress)?, None)
        }
        None => Err(unknown(command, &COMMANDS)),
    }
}

/// The error for a command that is not among the `known` ones; it suggests the one with the most similar
/// name.
pub fn unknown(command: &str, known: &[&str]) -> TaskError {
    let nearest = unripple_store::nearest(command, known.iter().copied());
    let nearest = nearest.map_or_else(String::new, |name| format!(" (nearest: {name})"));
    TaskError::ask("command", format!("one of {}{nearest}", known.join(", ")), format!("`{command}`"))
}
