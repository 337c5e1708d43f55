//! Modelled responses of a surface, with fingers on it.

use super::{ActError, Note};
use crate::core::{Contact, Responses, Surface};
use crate::physics::{self, Modes, ResponseOptions, response_modes, responses, responses_on};
use std::f64::consts::TAU;
use std::sync::Arc;

pub use crate::physics::accuracy;

/// Frequencies, as multiples of the top of an empty band, up to which the next mode above is searched for,
/// one after the other: first near the band, since few modes are computed quickly.
const FARTHER: [f64; 6] = [1.1, 1.3, 2.0, 4.0, 8.0, 16.0];

/// A note that the natural frequencies of `responses` are less accurate than [`accuracy()`] aims at; `None`
/// if they are not.
pub fn inexact(surface: &Surface, responses: &Responses) -> Option<Note> {
    let Responses::Modal(modal) = responses else { return None };
    less_accurate(modal.frequency_error, accuracy(surface).aim)
}

/// A note that the relative error of natural frequencies, `error`, is larger than the intended one, `aim`
/// (both ratios); `None` if it is not.
pub fn less_accurate(error: f64, aim: f64) -> Option<Note> {
    let text = || {
        format!(
            "the relative error of natural frequencies is up to {error:.1e}, not within {aim:e}, the default: no finer mesh that fits in memory \
             and keeps its digits is better (--accuracy asks for another accuracy, and refuses what does not reach it)"
        )
    };
    (error > aim).then(|| Note { topic: "accuracy", text: text() })
}

/// A bound of the relative error (root mean square) of responses in the first `seconds` (s), see [`physics::response_error()`]; `None` for
/// those that are not computed from modes, and with loads.
pub fn response_error(responses: &Responses, seconds: f64) -> Option<f64> {
    let Responses::Modal(modal) = responses else { return None };
    physics::response_error(modal, seconds)
}

/// A bound of a relative error in words, as a percentage of two digits that is not less.
///
/// ```
/// use unripple::act::at_most;
///
/// assert_eq!(at_most(0.0123), "at most 1.3 %");
/// assert_eq!([at_most(0.52), at_most(2.01e-5), at_most(0.0)], ["at most 52 %", "at most 0.0021 %", "rounding alone"]);
/// ```
pub fn at_most(error: f64) -> String {
    if error <= 0.0 {
        return "rounding alone".into();
    }
    let percent = 100.0 * error;
    let digits = 1 - percent.log10().floor() as i32;
    let scale = 10f64.powi(digits);
    // Less by far than what is printed, so that rounding errors do not raise it.
    let up = (percent * scale - 1e-9).ceil() / scale;
    let places = usize::try_from(digits).unwrap_or(0);
    format!("at most {up:.places$} %")
}

/// Computes the responses of a surface with fingers at `contacts`, from modes up to `max_hz` (Hz; by
/// default the top of its band).
///
/// # Errors
/// [`ActError::Empty`] if no mode is within the band; those of [`responses`].
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, ActError> {
    let options = ResponseOptions { contacts: contacts.to_vec(), ..options(surface, max_hz) };
    let found = responses(surface, &options)?;
    filled(surface, &options, found)
}

/// The modes of the sheet without loads from which [`model_on`] computes responses, up to `max_hz` (Hz; by default the top of the surface's
/// band): the same for all places of its actuators.
///
/// # Errors
/// Those of [`response_modes`].
pub fn model_modes(surface: &Surface, max_hz: Option<f64>) -> Result<Modes, ActError> {
    Ok(response_modes(surface, &options(surface, max_hz))?)
}

/// The responses of [`model`] without fingers, from modes that [`model_modes`] has computed up to the same frequency (Hz), for the same
/// surface or for one whose actuators are at other places.
///
/// # Errors
/// Those of [`model`].
///
/// ```
/// use std::sync::Arc;
/// use unripple::act::{model, model_modes, model_on};
///
/// let mut film = unripple::physics::design::papers_surface();
/// film.emission.band = [0.0, 500.0];
/// let modes = Arc::new(model_modes(&film, None)?);
/// film.actuators[0].at.x += 0.01;
/// let [own, shared] = [model(&film, None, &[])?, model_on(&film, modes, None)?];
/// assert_eq!(own.ports(), shared.ports());
/// # Ok::<(), unripple::act::ActError>(())
/// ```
pub fn model_on(surface: &Surface, modes: Arc<Modes>, max_hz: Option<f64>) -> Result<Responses, ActError> {
    let options = options(surface, max_hz);
    let found = responses_on(surface, modes, &options)?;
    filled(surface, &options, found)
}

/// The options of responses without fingers.
fn options(surface: &Surface, max_hz: Option<f64>) -> ResponseOptions {
    ResponseOptions { max_hz, accuracy: accuracy(surface), ..ResponseOptions::default() }
}

/// Responses that have a mode; an error if they have none.
fn filled(surface: &Surface, options: &ResponseOptions, found: Responses) -> Result<Responses, ActError> {
    match &found {
        Responses::Modal(modal) if modal.poles.is_empty() => {
            Err(ActError::Empty { band: surface.emission.band, next: next(surface, options) })
        }
        _ => Ok(found),
    }
}

/// The lowest mode above an empty band, in Hz, if it is within 16 times the top of the band.
fn next(surface: &Surface, options: &ResponseOptions) -> Option<f64> {
    let top = surface.emission.band[1];
    FARTHER.iter().find_map(|factor| {
        let farther = ResponseOptions { max_hz: Some(factor * top), ..options.clone() };
        let Ok(Responses::Modal(modal)) = responses(surface, &farther) else { return None };
        modal.poles.iter().map(|pole| pole.omega / TAU).reduce(f64::min)
    })
}
