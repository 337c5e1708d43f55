//! The points of a library, as typed.

use crate::error::CliError;
use crate::targets::{place, positive};
use unripple::core::{Outline, Point};
pub use unripple_tasks::grid::points;

pub fn places(outline: &Outline, grid_mm: Option<f64>, at: &[String]) -> Result<Vec<Point>, CliError> {
    let pitch = grid_mm.map(|mm| positive(mm, "--grid-mm", "mm").map(|mm| mm / 1e3)).transpose()?;
    let places = at.iter().map(|text| place(text, "--at").map(|at| [at.x, at.y]));
    Ok(unripple_tasks::grid::places(outline, pitch, &places.collect::<Result<Vec<_>, _>>()?)?)
}
