//! Fingers that rest on a surface, as typed.

use crate::error::CliError;
use crate::targets::place;
use unripple::core::{Contact, Surface};

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
