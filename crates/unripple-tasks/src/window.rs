//! Checks of windows and other times that must be long enough for waves.

use crate::TaskError;
use unripple::act;
use unripple::core::{Conditions, Surface};
use unripple::physics::Medium;

/// Sample rate, band, shortest wavelength and outline of a surface's responses, known before they are
/// computed.
pub(crate) fn conditions(surface: &Surface) -> Conditions {
    let (rate, band) = (surface.emission.rate, surface.emission.band);
    let lambda_min = Medium::of(&surface.sheet).lambda_min(band[1]);
    Conditions { rate, band, lambda_min, outline: surface.outline.clone() }
}

/// Returns an error if no wave of the band fits into `seconds`; it names `field`, which sets that time.
pub(crate) fn carries(conditions: &Conditions, seconds: f64, field: &str) -> Result<(), TaskError> {
    act::carries(conditions, seconds).map_err(|error| TaskError::Work(format!("`{field}`: {error}")))
}

/// Adds to an error about the default window (when none was `asked` for) the name of the field that sets
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
