//! A drive on a surface, judged before people's eyes.

use crate::error::CliError;
use indicatif::ProgressBar;
use std::time::Duration;
use unripple::act;
use unripple::core::{Contact, Responses, Surface};
use unripple::field::{Aim, Field};

pub use unripple::act::{CELLS, Judged, Note, accuracy};

/// A field longer than this, in seconds, takes long enough to measure that people should see it.
const LONG: f64 = 0.2;

/// A moving sign on a terminal that work goes on; nothing elsewhere.
fn waiting(what: String) -> ProgressBar {
    let spinner = ProgressBar::new_spinner().with_message(what);
    spinner.enable_steady_tick(Duration::from_millis(120));
    spinner
}

/// The responses of a surface, on modes up to `max_hz` if given, under fingers.
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, CliError> {
    Ok(act::model(surface, max_hz, contacts)?)
}

/// Measures what the field of a drive is at the aims. Traces last until `until` seconds, or as long as the field is known.
pub fn judge(
    surface: &Surface,
    field: &Field,
    aims: &[Aim],
    period: Option<f64>,
    until: f64,
) -> Result<Judged, CliError> {
    seen(until.min(act::known(field)), || act::judge(surface, field, aims, period, until))
}

/// Does work on a field of `length` seconds, seen where that takes long.
pub fn seen<T>(length: f64, work: impl FnOnce() -> Result<T, act::ActError>) -> Result<T, CliError> {
    let spinner = (length > LONG).then(|| waiting(format!("measuring {length:.2} s of the whole surface")));
    let done = work();
    if let Some(spinner) = spinner {
        spinner.finish_and_clear();
    }
    Ok(done?)
}
