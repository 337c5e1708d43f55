//! Modelled responses of a surface, with fingers on it.

use super::{ActError, Note};
use crate::core::{Contact, Responses, Shape, Surface};
use crate::physics::{Accuracy, ResponseOptions, responses};
use std::f64::consts::TAU;

/// Relative accuracy of natural frequencies that are computed on a mesh: a phase error of 0.06 rad at 3 kHz after 30
/// ms for the highest mode, and far less for lower ones.
const MESHED: f64 = 1e-4;

/// Frequencies up to which the next mode above an empty band is looked for, one after the other, as multiples of its top: near it
/// first, since few modes are computed quickly.
const FARTHER: [f64; 6] = [1.1, 1.3, 2.0, 4.0, 8.0, 16.0];

/// Relative accuracy to which the natural frequencies of a surface are computed: its own, or by default that of [`ResponseOptions`] for
/// plain rectangles, 1e-4 where a mesh is needed. Where that is out of reach, the surface's own is refused, and in place of the default
/// the best that can be reached is taken ([`Accuracy::or_best`]).
pub fn accuracy(surface: &Surface) -> Accuracy {
    let plain = matches!(surface.outline.shape, Shape::Rectangle { .. })
        && surface.outline.holes.is_empty()
        && surface.sheet.uneven.is_nothing();
    Accuracy::of(surface.accuracy, if plain { ResponseOptions::default().accuracy.aim } else { MESHED })
}

/// A note that natural frequencies are less accurate than was aimed at, where that was out of reach.
pub fn inexact(surface: &Surface, responses: &Responses) -> Option<Note> {
    let Responses::Modal(modal) = responses else { return None };
    less_accurate(modal.frequency_error, accuracy(surface).aim)
}

/// A note that natural frequencies have a larger `error` than the one aimed at, both ratios to the frequencies; `None` if they have not.
pub fn less_accurate(error: f64, aim: f64) -> Option<Note> {
    let text = || {
        format!(
            "the relative error of natural frequencies is up to {error:.1e}, not within {aim:e}, the default: no finer mesh that fits in memory \
             and keeps its digits is better (--accuracy asks for another accuracy, and refuses what does not reach it)"
        )
    };
    (error > aim).then(|| Note { topic: "accuracy", text: text() })
}

/// The responses of a surface with fingers at `contacts`, on modes up to `max_hz` (Hz), or those of its band.
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
