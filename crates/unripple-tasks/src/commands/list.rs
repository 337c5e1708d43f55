//! The list of all tasks.

use super::done::{Done, Names, again, default_of, perform, renamed};
use crate::record::{Record, Request};
use crate::{Progress, TaskError};
use crate::{
    calibrate, check, compare, design, devices, doctor, drift, export, field, fit, fit_modes, focus, import,
    listen, materials, modes, place, play, respond, sensors, stroke, verify, waveform,
};
use serde_json::Value;
use std::path::PathBuf;

/// A task as a command.
pub(crate) struct Command {
    /// Name of the command, in lower case.
    pub(crate) name: &'static str,
    /// Returns the default request of the command, as JSON.
    pub(crate) default_ask: fn() -> Result<Value, TaskError>,
    /// Checks that a request has known fields with values of the right kinds, and has the surfaces and files that it names renamed.
    pub(crate) renamed: fn(Value, &mut dyn Names) -> Result<Value, TaskError>,
    /// Performs the command, from its request as JSON.
    pub(crate) run: fn(Value, &mut dyn Progress) -> Result<Done, TaskError>,
    /// Repeats a recorded run of the command, with its results written to another path.
    pub(crate) again: fn(&Record, Option<PathBuf>, &mut dyn Progress) -> Result<Done, TaskError>,
}

/// Makes a command of the module of each task.
macro_rules! commands {
    ($($task:ident),*) => {
        [$(Command {
            name: $task::Ask::COMMAND,
            default_ask: default_of::<$task::Ask>,
            renamed: renamed::<$task::Ask>,
            run: |ask, progress| perform(ask, $task::run, progress),
            again: |record, output, progress| again(record, output, $task::run, progress),
        }),*]
    };
}

/// The tasks in the order in which a surface is developed: designed, simulated, driven, measured, played.
pub(crate) const TASKS: &[Command] = &commands![
    check, design, modes, materials, place, sensors, focus, waveform, stroke, field, compare, respond,
    calibrate, import, fit, listen, fit_modes, export, verify, drift, doctor, devices, play
];

/// The task called `name`; `None` if there is none.
pub(crate) fn find(name: &str) -> Option<&'static Command> {
    TASKS.iter().find(|task| task.name == name)
}
