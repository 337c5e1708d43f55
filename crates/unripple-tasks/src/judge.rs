//! Responses from the model of a surface, and evaluation of a drive's field on it.

use crate::{Progress, Solved, TaskError, go_on};
use unripple::act::{self, Hearing, Sound};
use unripple::core::{Contact, Drive, Responses, Surface};
use unripple::field::{Aim, Field};

pub use unripple::act::{CELLS, JUDGED_BANDS, Judged, Judging, Note, Reached, accuracy, reached};

/// Name of the stage that computes the responses on which a drive is evaluated.
pub(crate) const RESPONSES: &str = "responses for evaluation";

/// Length of a field, in seconds, above which its evaluation takes so long that it is reported as a
/// separate stage.
const LONG: f64 = 0.2;

/// Computes the responses of a surface from its modes up to `max_hz` (Hz; by default the top of its band),
/// with fingers resting at `contacts`.
///
/// # Errors
/// Those of [`act::model`].
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, TaskError> {
    Ok(act::model(surface, max_hz, contacts)?)
}

/// Responses of a surface that a drive is evaluated on, all from modes up to the same frequency.
pub struct Models {
    /// Responses without fingers on the surface.
    pub free: Responses,
    /// Responses with fingers resting on the surface; `None` if there are no fingers.
    pub under: Option<Responses>,
}

/// Computes the responses that a drive is evaluated on, from modes up to `asked` (Hz) or by default up to
/// the frequency that [`Judging::of`] chooses, and returns that choice too. What the cache `solved` holds
/// is not computed again.
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

/// Returns an error if `judge_hz`, the highest frequency (Hz) of the modes that a drive is evaluated on, is
/// below the top of the surface's band, or not below half its sample rate.
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

/// The height of the listener above the surface, in m: the requested one, or by default [`act::LISTEN_M`]. Nearer than 5 cm the air moves with
/// the sheet, and the integral over it would need ever more points.
///
/// # Errors
/// [`TaskError::Ask`] of a height below 0.05 m or above 100 m.
pub(crate) fn listening(listen_m: Option<f64>) -> Result<f64, TaskError> {
    match listen_m {
        Some(height) if !(0.05..=100.0).contains(&height) => {
            Err(TaskError::ask("listen_m", "a height from 0.05 to 100 m", height))
        }
        asked => Ok(asked.unwrap_or(act::LISTEN_M)),
    }
}

/// The sound of a drive on a surface that moves as `responses` say, `listen_m` metres above its middle; `period` (s) is that of a repeated
/// drive.
///
/// # Errors
/// [`TaskError::Ask`] of a height that makes no sense; those of [`act::Hearing`].
pub(crate) fn heard(
    surface: &Surface,
    responses: &Responses,
    listen_m: Option<f64>,
    drive: &Drive,
    period: Option<f64>,
) -> Result<Sound, TaskError> {
    Ok(Hearing::new(surface, responses, listening(listen_m)?)?.sound(drive, period)?)
}

/// Evaluates the field of a drive at the places and instants `aims`; `period` (s) is that of a repeated
/// drive. Traces end at `until` (s), or where the field is no longer known.
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

/// Runs `work`, which evaluates `length` seconds of a field, and reports it to `progress` as a separate
/// stage if `length` is above 0.2 s.
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
