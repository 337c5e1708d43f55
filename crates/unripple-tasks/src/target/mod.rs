//! Targets and level of a focus, as requests specify them.

mod level;
mod point;
mod shape;

pub use level::LevelAsk;
pub use point::PointAsk;
pub use shape::{LineAsk, ShapeAsk};

use crate::TaskError;
use unripple::focus::{Pattern, Target};

/// Targets of a request: points first, then shapes, which are sampled at points close enough for the
/// shortest wavelength `lambda_min` (m).
///
/// # Errors
/// [`TaskError::Ask`] if there is none, and of shapes that make no sense; those of reading drawings.
pub fn targets(points: &[PointAsk], shapes: &[ShapeAsk], lambda_min: f64) -> Result<Vec<Target>, TaskError> {
    let mut targets = points.iter().map(PointAsk::target).collect::<Result<Vec<_>, _>>()?;
    for shape in shapes {
        let sampled = shape.pattern("shapes")?.sample(Pattern::pitch(lambda_min));
        targets.push(Target::of(sampled.map_err(|error| TaskError::Input(format!("`shapes`: {error}")))?));
    }
    if targets.is_empty() {
        return Err(TaskError::ask("points, shapes", "`points` or `shapes`", "none"));
    }
    Ok(targets)
}
