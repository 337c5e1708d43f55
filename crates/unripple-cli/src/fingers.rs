//! Fingers that rest on a surface, as typed.

use crate::error::CliError;
use crate::targets::place;
use unripple::core::{Contact, Surface};

pub fn contacts(typed: &[String], surface: &Surface) -> Result<Vec<Contact>, CliError> {
    let places = typed.iter().map(|text| place(text, "--finger").map(|at| [at.x, at.y]));
    let places = places.collect::<Result<Vec<_>, _>>()?;
    Ok(unripple_tasks::fingers::contacts(&places, "finger", surface)?)
}
