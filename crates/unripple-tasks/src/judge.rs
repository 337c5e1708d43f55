//! Responses from the model of a surface, and figures of a drive's field on it.

use crate::{Progress, Solved, TaskError, go_on};
use unripple::act;
use unripple::core::{Contact, Responses, Surface};
use unripple::field::{Aim, Field};

pub use unripple::act::{CELLS, JUDGED_BANDS, Judged, Judging, Note, Reached, accuracy, reached};

/// The stage in which the responses are computed that a drive is evaluated on.
pub(crate) const RESPONSES: &str = "responses for evaluation";

/// A field longer than this, in seconds, takes long enough to measure that people should see it.
const LONG: f64 = 0.2;

/// Responses of a surface computed from its modes, up to `max_hz` (Hz) or by default those of its band, under resting fingers.
///
/// # Errors
/// Those of [`act::model`].
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, TaskError> {
    Ok(act::model(surface, max_hz, contacts)?)
}

/// Responses of a surface that a drive is evaluated on, all from modes up to the same frequency.
pub struct Models {
    /// Those without fingers on the surface.
    pub free: Responses,
    /// Those under the resting fingers, if there are any.
    pub under: Option<Responses>,
}

/// The responses that a drive is evaluated on, and how far their modes go: up to `asked` (Hz), or by default as [`Judging::of`] says.
/// What has been `solved` before is not computed again.
///
/// # Errors
/// Those of [`act::model`].
pub fn models(
    surface: &Surface,
    asked: Option<f64>,
    contacts: &[Contact],
    solved: &Solved,
) -> Result<(Models, Judging), TaskError> {
    let found = Judging::of(surface, asked, |hz| {
        let free = solved.model(surface, Some(hz), &[])?;
        let touched = !contacts.is_empty();
        let under = touched.then(|| solved.model(surface, Some(hz), contacts)).transpose()?;
        Ok(Models { free, under })
    });
    let (models, judging) = found?;
    let judging = judging.told_of(surface, &models.free);
    Ok((models, judging))
}

/// Refuses a highest frequency (Hz) of the modes to evaluate a drive on that is below the band of a surface, or above what its sample rate
/// carries, before there are modes.
pub(crate) fn reaches(surface: &Surface, judge_hz: Option<f64>) -> Result<(), TaskError> {
    let (top, carried) = (surface.emission.band[1], 0.5 * surface.emission.rate);
    match judge_hz.filter(|hz| !(top..carried).contains(hz)) {
        Some(hz) => Err(TaskError::ask(
            "judge_hz",
            format!(
                "at least {top} Hz, the top of the band, and less than {carried} Hz, half the sample rate"
            ),
            format!("{hz} Hz"),
        )),
        None => Ok(()),
    }
}

/// Evaluates the field of a drive at the aims, which are places and instants. `period` (s) is that of a repeated drive. Traces end at
/// `until` (s), or where the field is no longer known.
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

/// Runs `work` on a field of `length` (s), and reports it as a stage of its own if the field is long (above 0.2 s).
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
