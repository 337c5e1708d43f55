//! All commands by their names: those of the tasks, and `reproduce`.

use crate::reproduce;
use serde_json::Value;
use unripple_tasks::commands::{self, Done, again, asked, default_of, perform, unknown};
use unripple_tasks::record::Request;
use unripple_tasks::{Progress, Record, TaskError, go_on, rerun};

/// Names of all commands that [`run`] performs: those of the tasks, and `reproduce`.
pub const COMMANDS: [&str; commands::COMMANDS.len() + 1] = {
    let mut names = [reproduce::Ask::COMMAND; commands::COMMANDS.len() + 1];
    let mut at = 0;
    while at < commands::COMMANDS.len() {
        names[at] = commands::COMMANDS[at];
        at += 1;
    }
    names
};

/// The default request of a command: all its fields with their default values, as JSON.
///
/// # Errors
/// [`unknown`].
pub fn default_ask(command: &str) -> Result<Value, TaskError> {
    match command {
        reproduce::Ask::COMMAND => default_of::<reproduce::Ask>(),
        _ if COMMANDS.contains(&command) => commands::default_ask(command),
        _ => Err(unknown(command, &COMMANDS)),
    }
}

/// Performs a command by its name; fields that are absent from the request `ask` get their defaults.
///
/// ```
/// use unripple_paper::commands;
/// use unripple_tasks::Silent;
///
/// let done = commands::run("materials", serde_json::json!({ "name": "glass" }), &mut Silent)?;
/// assert!(done.json.contains("\"command\": \"materials\""));
/// let refused = commands::run("reproduse", serde_json::json!({}), &mut Silent).unwrap_err();
/// assert!(refused.to_string().contains("(nearest: reproduce)"));
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`unknown`]; [`TaskError::Input`] of a request with a field that the command does not know, or a value that the field cannot have;
/// those of the command.
pub fn run(command: &str, ask: Value, progress: &mut dyn Progress) -> Result<Done, TaskError> {
    match command {
        reproduce::Ask::COMMAND => perform(ask, reproduce::run, progress),
        rerun::Ask::COMMAND => {
            let ask: rerun::Ask = asked(ask)?;
            go_on(progress)?;
            Done::of(&repeat(&rerun::record(&ask)?, &ask, progress)?, None)
        }
        _ if COMMANDS.contains(&command) => commands::run(command, ask, progress),
        _ => Err(unknown(command, &COMMANDS)),
    }
}

/// Repeats a recorded run; `ask` names the report that the record is from and where results are written.
///
/// # Errors
/// Those of [`rerun::repeat`].
pub fn repeat(
    record: &Record,
    ask: &rerun::Ask,
    progress: &mut dyn Progress,
) -> Result<rerun::Report, TaskError> {
    match record.command.as_str() {
        reproduce::Ask::COMMAND => {
            rerun::Report::of(again(record, ask.output.clone(), reproduce::run, progress)?)
        }
        _ => rerun::repeat(record, ask, progress),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use unripple_tasks::Silent;

    #[test]
    fn the_papers_command_is_one_of_all() {
        assert!(
            COMMANDS.contains(&"reproduce") && COMMANDS.contains(&"rerun") && COMMANDS.contains(&"focus")
        );
        for command in COMMANDS {
            assert!(default_ask(command).unwrap().is_object(), "{command}");
        }
        assert_eq!(default_ask("reproduce").unwrap(), json!({ "output": null, "placements": 20 }));
        let refused = run("reproduce", json!({ "placements": 1 }), &mut Silent).unwrap_err();
        assert!(matches!(refused, TaskError::Ask { field: "placements", .. }), "{refused}");
        let refused = run("reproduce", json!({ "place": 1 }), &mut Silent).unwrap_err();
        assert!(refused.to_string().contains("unknown field `place`"), "{refused}");
    }
}
