//! The model's responses of a surface, fingers on it included.

use super::ActError;
use crate::core::{Contact, Responses, Shape, Surface};
use crate::physics::{ResponseOptions, responses};

/// Accuracy of the frequencies where they take a mesh: a phase of 0.06 rad at 3 kHz after 30 ms, alike in drive and judgement.
const MESHED: f64 = 1e-4;

/// Relative accuracy, a ratio, that a surface's frequencies are worth: of what takes a mesh, no more than a drive can
/// tell.
pub fn accuracy(surface: &Surface) -> f64 {
    let plain = matches!(surface.outline.shape, Shape::Rectangle { .. })
        && surface.outline.holes.is_empty()
        && surface.sheet.uneven.is_nothing();
    if plain { ResponseOptions::default().accuracy } else { MESHED }
}

/// The responses of a surface, on modes up to `max_hz` if given, under fingers.
///
/// # Errors
/// Those of [`responses`].
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, ActError> {
    let accuracy = accuracy(surface);
    let contacts = contacts.to_vec();
    Ok(responses(surface, &ResponseOptions { max_hz, accuracy, contacts, ..ResponseOptions::default() })?)
}
