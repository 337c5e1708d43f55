//! Fingers that rest on a surface.

use crate::{Place, TaskError, point};
use unripple::core::{Contact, Surface};

/// Contacts of fingers resting at some places (m), each with the finger model of the surface file.
///
/// # Errors
/// [`TaskError::Ask`] that names `field` for a place beyond the rim.
pub fn contacts(places: &[Place], field: &'static str, surface: &Surface) -> Result<Vec<Contact>, TaskError> {
    let contact = |place: &Place| {
        let at = point(place);
        if surface.outline.contains(at) {
            return Ok(Contact { at, finger: surface.finger });
        }
        let nearest = surface.outline.nearest(at);
        let found =
            format!("{at}, beyond its rim (nearest: {:.4},{:.4} mm)", nearest.x * 1e3, nearest.y * 1e3);
        Err(TaskError::ask(field, "a place on the surface", found))
    };
    places.iter().map(contact).collect()
}
