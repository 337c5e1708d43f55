//! Times that must hold waves.

use crate::TaskError;
use unripple::act;
use unripple::core::Conditions;

/// Refuses a time that no wave of the band fits into, naming the field that makes it longer.
pub(crate) fn carries(conditions: &Conditions, seconds: f64, field: &str) -> Result<(), TaskError> {
    act::carries(conditions, seconds).map_err(|error| TaskError::Work(format!("`{field}`: {error}")))
}

/// An error, and if it is about a window that nobody `asked` for, the field that gives another.
pub(crate) fn of_window(error: TaskError, asked: bool) -> TaskError {
    let told = |text: String| match !asked && text.contains("window") && !text.contains("window_s") {
        true => format!("{text} (the window is the default one; `window_s` gives another)"),
        false => text,
    };
    match error {
        TaskError::Input(text) => TaskError::Input(told(text)),
        TaskError::Work(text) => TaskError::Work(told(text)),
        other => other,
    }
}
