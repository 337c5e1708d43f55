//! The model of a surface, and the field of a drive on it, measured.

use crate::{Progress, TaskError, go_on};
use unripple::act;
use unripple::core::{Contact, Responses, Surface};
use unripple::field::{Aim, Field};

pub use unripple::act::{CELLS, Judged, Note, accuracy};

/// A field longer than this, in seconds, takes long enough to measure that people should see it.
const LONG: f64 = 0.2;

/// The responses of a surface, on modes up to `max_hz` if given, under fingers.
///
/// # Errors
/// Those of [`act::model`].
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, TaskError> {
    Ok(act::model(surface, max_hz, contacts)?)
}

/// Measures what the field of a drive is at the aims. Traces last until `until` seconds, or as long as the field is known.
///
/// # Errors
/// Those of [`act::judge`]; [`TaskError::Cancelled`].
pub fn judge(
    surface: &Surface,
    field: &Field,
    aims: &[Aim],
    period: Option<f64>,
    until: f64,
    progress: &mut dyn Progress,
) -> Result<Judged, TaskError> {
    seen(until.min(act::known(field)), progress, || act::judge(surface, field, aims, period, until))
}

/// Does work on a field of `length` seconds, seen where that takes long.
///
/// # Errors
/// Those of the work; [`TaskError::Cancelled`].
pub fn seen<T>(
    length: f64,
    progress: &mut dyn Progress,
    work: impl FnOnce() -> Result<T, act::ActError>,
) -> Result<T, TaskError> {
    go_on(progress)?;
    if length > LONG {
        progress.stage(&format!("evaluating {length:.2} s of the whole surface"));
    }
    let done = work()?;
    go_on(progress)?;
    Ok(done)
}
