//! The animated field, as APNG.

use super::Scene;
use super::maps::{drawn, scale};
use crate::TaskError;
use unripple::field::Field;
use unripple_plot::{ColourMap, Movie, Shot};

/// An animated PNG of the displacement over the surface at `frames` instants from `from` to `to` seconds; `None`
/// without a grid.
pub fn movie(
    field: &Field,
    scene: &Scene,
    [from, to]: [f64; 2],
    frames: usize,
) -> Result<Option<Vec<u8>>, TaskError> {
    let Some(cells) = field.grid().cloned() else { return Ok(None) };
    let step = (to - from) / (frames.max(2) - 1) as f64;
    let instants: Vec<f64> = (0..frames).map(|i| from + i as f64 * step).collect();
    let snapshots = field.snapshots(&instants).map_err(TaskError::input)?;
    let shots = snapshots.iter().map(|s| {
        let caption = format!("t = {:.2} ms", s.instant * 1e3);
        Shot { grid: drawn(&cells, &s.displacement), caption }
    });
    let all: Vec<f32> = snapshots.iter().flat_map(|s| s.displacement.iter().copied()).collect();
    let movie = Movie {
        shots: shots.collect(),
        outline: scene.outline.clone(),
        markers: scene.markers.clone(),
        colours: scale("Displacement", "m", ColourMap::Diverging, &all),
        ..Movie::default()
    };
    Ok(Some(movie.apng()?))
}
