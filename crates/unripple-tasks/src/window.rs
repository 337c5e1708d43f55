//! Checks of windows and other times that must be long enough for waves.

use crate::TaskError;
use unripple::act;
use unripple::core::{Conditions, Surface};
use unripple::physics::Medium;

/// Rate, band and region of the responses that a surface will have.
pub(crate) fn conditions(surface: &Surface) -> Conditions {
    let (rate, band) = (surface.emission.rate, surface.emission.band);
    let lambda_min = Medium::of(&surface.sheet).lambda_min(band[1]);
    Conditions { rate, band, lambda_min, outline: surface.outline.clone() }
}

/// Refuses a time that no wave of the band fits into, naming the field that makes it longer.
pub(crate) fn carries(conditions: &Conditions, seconds: f64, field: &str) -> Result<(), TaskError> {
    act::carries(conditions, seconds).map_err(|error| TaskError::Work(format!("`{field}`: {error}")))
}

/// Adds to an error about the window, if it is the default one (not `asked` for), the name of the field that sets
/// another.
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
