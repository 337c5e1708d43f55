//! The animation of a field, as an animated PNG (APNG).

use super::Scene;
use super::maps::{drawn, scale};
use crate::TaskError;
use unripple::act;
use unripple::field::Field;
use unripple_plot::{ColourMap, Movie, Shot};

/// Largest number of frames of an animation: it then lasts five and a half minutes. With twice this value, files are twice as large.
pub const MOST_FRAMES: usize = 5000;

/// Largest number of cells of all frames together, whose values take 400 MB. With twice this value, it takes twice the memory.
const MOST_CELLS: usize = 50_000_000;

/// Checks the request for an animation before the field is evaluated: returns an error if its frames do not
/// fit in memory, or if its span (start and end, in s) ends after the field is known.
///
/// # Errors
/// [`TaskError::Ask`] that names `frames` or `movie_s`.
pub fn check_animation(field: &Field, frames: usize, span: Option<[f64; 2]>) -> Result<(), TaskError> {
    let Some(cells) = field.grid() else { return Ok(()) };
    let each = cells.columns * cells.rows;
    if frames.saturating_mul(each) > MOST_CELLS {
        let expected = format!("at most {}, for a grid of {each} cells", MOST_CELLS / each);
        return Err(TaskError::ask("frames", expected, frames));
    }
    let known = act::known(field);
    match span.filter(|[_, to]| *to > known) {
        Some([_, to]) => Err(TaskError::ask(
            "movie_s",
            format!("an end after {known:.0} s at the latest"),
            format!("{to} s"),
        )),
        None => Ok(()),
    }
}

/// An animated PNG of the displacement over the surface at `frames` instants from `from` to `to` seconds;
/// `None` if the field has no grid.
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
