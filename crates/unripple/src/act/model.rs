//! Modelled responses of a surface, with fingers on it.

use super::{ActError, Note};
use crate::core::{Contact, Responses, Surface};
use crate::physics::{ResponseOptions, responses};
use std::f64::consts::TAU;

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

/// Computes the responses of a surface with fingers at `contacts`, from modes up to `max_hz` (Hz; by
/// default the top of its band).
///
/// # Errors
/// [`ActError::Empty`] if no mode is within the band; those of [`responses`].
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, ActError> {
    let accuracy = accuracy(surface);
    let contacts = contacts.to_vec();
    let options = ResponseOptions { max_hz, accuracy, contacts, ..ResponseOptions::default() };
    let found = responses(surface, &options)?;
    if let Responses::Modal(modal) = &found
        && modal.poles.is_empty()
    {
        return Err(ActError::Empty { band: surface.emission.band, next: next(surface, &options) });
    }
    Ok(found)
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
