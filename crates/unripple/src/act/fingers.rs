//! Motion of fingers under a drive, and the power that they absorb.

use super::ActError;
use crate::core::{Contact, Drive, Responses, Surface};
use crate::field::Field;
use crate::{Touch, touch};
use serde::Serialize;

/// Motion of one finger under a drive, and how much fingers reduce the motion of the surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Felt {
    /// Motion of the finger, and the power that it absorbs.
    #[serde(flatten)]
    pub loaded: Touch,
    /// Peak velocity at the contact disc without fingers on the surface, divided by that with the fingers
    /// (ratio).
    pub velocity_attenuation: f64,
    /// Peak displacement at the contact disc without fingers on the surface, divided by that with the
    /// fingers (ratio).
    pub displacement_attenuation: f64,
}

/// Motion of every finger under a drive up to `until` (s). `under` are the responses of the surface with all fingers on
/// it, `without` those of the bare surface.
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
