//! Responses at targets between the points of a library, by interpolation.

use crate::TaskError;
use unripple::act::Note;
use unripple::core::{Point, SampledResponses, Surface};
use unripple::physics::Medium;
use unripple_calibrate::{Between, BetweenOptions, Interpolation};

/// Distance from every target, in shortest wavelengths, beyond which stored points are not used to
/// interpolate.
const REACH: f64 = 5.0;

/// Distance in metres within which a place counts as a stored point. Far below any wavelength:
/// interpolation would give the same.
const SAME: f64 = 1e-6;

/// Adds interpolated responses to the stored ones, at those of the `places` (m) that are not among the stored points,
/// and returns a note on their estimated error. With [`Interpolation::Nearest`] nothing is added.
pub fn completed(
    stored: SampledResponses,
    surface: &Surface,
    places: &[Point],
    way: Interpolation,
) -> Result<(SampledResponses, Vec<Note>), TaskError> {
    let known = |place: &Point| stored.points.iter().any(|point| point.distance(*place) < SAME);
    let new: Vec<Point> = places.iter().copied().filter(|place| !known(place)).collect();
    if new.is_empty() || way == Interpolation::Nearest {
        return Ok((stored, Vec::new()));
    }
    let witnesses = witnesses(&stored, &new)?;
    let medium = Medium::of(&surface.sheet).with_air(surface.sheet.air);
    let options = BetweenOptions { interpolation: way, ..BetweenOptions::default() };
    let between =
        Between::plan(&witnesses, |omega| medium.wavenumber(omega), &options).map_err(TaskError::input)?;
    let made = between.onto(&new).map_err(TaskError::input)?;
    let worst = new
        .iter()
        .try_fold(0.0, |worst: f64, place| Ok::<_, TaskError>(worst.max(error(&between, *place)?)))?;
    let lies = if new.len() == 1 { format!("{} lies", new[0]) } else { format!("{} places lie", new.len()) };
    let text = format!(
        "{lies} between the points: responses there are interpolated ({}), off by about {:.1} %",
        way.name(),
        worst * 100.0
    );
    Ok((stored.joined(made).map_err(TaskError::work)?, vec![Note { topic: "library", text }]))
}

fn error(between: &Between, place: Point) -> Result<f64, TaskError> {
    Ok(between.error(place).map_err(TaskError::input)?.relative)
}

/// The stored points around some places. Points at actuators are left out: there the field is more than a sum of free
/// waves.
fn witnesses(stored: &SampledResponses, places: &[Point]) -> Result<SampledResponses, TaskError> {
    let reach = REACH * stored.conditions.lambda_min;
    let free = |point: &Point| stored.ports.iter().all(|port| port.at.distance(*point) > SAME);
    let near = |point: &Point| places.iter().any(|place| place.distance(*point) <= reach);
    let all: Vec<usize> = (0..stored.points.len()).filter(|i| free(&stored.points[*i])).collect();
    let close: Vec<usize> = all.iter().copied().filter(|i| near(&stored.points[*i])).collect();
    let chosen = if close.len() < 4 { all } else { close };
    stored.select(&chosen).map_err(TaskError::work)
}
