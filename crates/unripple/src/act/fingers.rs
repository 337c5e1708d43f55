//! Sensations of fingers under a drive, and the power that they absorb and scatter.

use super::ActError;
use crate::core::{Contact, Drive, Responses, Surface};
use crate::field::Field;
use crate::{Touch, touch};
use serde::Serialize;

/// The sensation of one finger under a drive, and what the finger does to the waves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Felt {
    /// Sensation of the finger and the power that it absorbs.
    #[serde(flatten)]
    pub loaded: Touch,
    /// Velocity of the same contact disc without the fingers, over that with them.
    pub velocity_attenuation: f64,
    /// Attenuation of the displacement.
    pub displacement_attenuation: f64,
}

/// The sensation of every finger under a drive up to `until` (s), from the responses under all of them and those without.
///
/// # Errors
/// Those of [`Field::new`] and [`touch()`].
pub fn felt(
    contacts: &[Contact],
    surface: &Surface,
    [under, without]: [&Responses; 2],
    drive: &Drive,
    until: f64,
) -> Result<Vec<Felt>, ActError> {
    if contacts.is_empty() {
        return Ok(Vec::new());
    }
    let (under, without) = (Field::new(under, drive, 1.0)?, Field::new(without, drive, 1.0)?);
    let each = contacts.iter().map(|contact| {
        let one = |field| touch(field, contact, &surface.outline, until);
        let (loaded, free) = (one(&under)?, one(&without)?);
        Ok(Felt {
            loaded,
            velocity_attenuation: free.peak_velocity_m_s / loaded.peak_velocity_m_s,
            displacement_attenuation: free.peak_displacement_m / loaded.peak_displacement_m,
        })
    });
    each.collect()
}
