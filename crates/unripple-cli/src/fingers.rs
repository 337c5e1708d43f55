//! Fingers that rest on a surface, and what they do to a focus.

use crate::error::CliError;
use crate::targets::place;
use serde::Serialize;
use unripple::core::{Contact, Surface};
use unripple::field::Field;
use unripple::{Touch, touch};

/// One finger in a report.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Felt {
    /// What it feels and takes.
    #[serde(flatten)]
    pub loaded: Touch,
    /// Velocity of the same contact disc without the fingers, over that with them.
    pub velocity_attenuation: f64,
    /// The same in displacement.
    pub displacement_attenuation: f64,
}

/// The fingers typed as `X,Y` in mm, as the surface's file describes them.
pub fn contacts(typed: &[String], surface: &Surface) -> Result<Vec<Contact>, CliError> {
    typed
        .iter()
        .map(|text| {
            let at = place(text, "--finger")?;
            if !surface.outline.contains(at) {
                let nearest = surface.outline.nearest(at);
                return Err(CliError::Input(format!(
                    "--finger {text}: expected a place on the surface, found one beyond its rim (nearest: {:.4},{:.4})",
                    nearest.x * 1e3,
                    nearest.y * 1e3
                )));
            }
            Ok(Contact { at, finger: surface.finger })
        })
        .collect()
}

/// What each finger feels of the field under all of them, beside the field of the same drive without.
pub fn felt(
    contacts: &[Contact],
    surface: &Surface,
    under: &Field,
    without: &Field,
    until: f64,
) -> Result<Vec<Felt>, CliError> {
    contacts
        .iter()
        .map(|contact| {
            let one = |field| touch(field, contact, &surface.outline, until).map_err(CliError::input);
            let (loaded, free) = (one(under)?, one(without)?);
            Ok(Felt {
                loaded,
                velocity_attenuation: free.peak_velocity_m_s / loaded.peak_velocity_m_s,
                displacement_attenuation: free.peak_displacement_m / loaded.peak_displacement_m,
            })
        })
        .collect()
}
