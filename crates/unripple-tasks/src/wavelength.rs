//! The wavelength of a measured library, from how its responses correlate in space, beside that of its surface file.

use crate::TaskError;
use serde_json::{Value, json};
use unripple::core::{Point, SampledResponses, Surface};
use unripple::physics::Medium;
use unripple_calibrate::{central, wavelength};
use unripple_store::Library;

/// Key of the library's log entry.
pub(crate) const KEY: &str = "wavelength";

/// Largest number of samples that are held, 80 MB: responses that are longer than this allows are cut off, since their beginning tells enough.
const MOST_SAMPLES: usize = 20_000_000;

/// Difference from the file's wavelength, in standard errors and relative, from which on it is said: the estimate is a few per cent off where
/// there are few modes.
const ERRORS: f64 = 3.0;
const APART: f64 = 0.12;

/// Estimates the wavelength at the top of the band from the responses at these points of a library, and logs it beside that of the
/// surface's file; the log is empty where the responses do not tell it.
///
/// # Errors
/// [`TaskError::Work`] if the library cannot be read or written.
pub(crate) fn log(library: &mut Library, points: &[usize], surface: &Surface) -> Result<(), TaskError> {
    let found = estimate(library, points)?;
    let told = found.map_or(Value::Null, |found| {
        let of_file = Medium::of(&surface.sheet).lambda_min(found.hz);
        let apart = (found.metres - of_file).abs();
        let mut told = json!({
            "estimated_m": found.metres,
            "error_m": found.error,
            "first_zero_m": found.first_zero,
            "at_hz": found.hz,
            "of_file_m": of_file,
        });
        if apart > ERRORS * found.error && apart > APART * of_file {
            told["said"] = json!(format!(
                "at {:.0} Hz the responses correlate in space as waves of {:.1} +- {:.1} mm do, those of the surface file have {:.1} mm: focal \
                 discs, and contrasts with them, are those of the file; correct its tension or its material",
                found.hz,
                1e3 * found.metres,
                1e3 * found.error,
                1e3 * of_file
            ));
        }
        told
    });
    Ok(library.log(KEY, told)?)
}

/// The estimate, of whose points no others are read than those it looks at.
fn estimate(
    library: &Library,
    points: &[usize],
) -> Result<Option<unripple_calibrate::Wavelength>, TaskError> {
    if points.is_empty() {
        return Ok(None);
    }
    let place = |point: &usize| library.points()[*point];
    let all: Vec<Point> = points.iter().map(place).collect();
    let near: Vec<usize> = central(&all).into_iter().map(|index| points[index]).collect();
    let plan = library.plan();
    let kept = (MOST_SAMPLES / (near.len() * plan.ports.len()).max(1)).min(plan.samples);
    let mut data = Vec::new();
    for point in &near {
        let all = library.get(*point)?;
        all.chunks_exact(plan.samples).for_each(|response| data.extend_from_slice(&response[..kept]));
    }
    let places = near.iter().map(place).collect();
    let responses = SampledResponses::new(plan.ports.clone(), places, plan.conditions.clone(), kept, data)
        .map_err(TaskError::work)?;
    wavelength(&responses).map_err(TaskError::work)
}

/// What the log of a library says of its wavelength; `None` where its responses do not tell it.
pub(crate) fn logged(library: &Library) -> Option<Value> {
    library.logged(KEY).filter(|told| told.is_object()).cloned()
}

/// The estimate as a line of text for people.
pub(crate) fn text(told: &Value) -> String {
    let of = |key: &str| told[key].as_f64().unwrap_or(f64::NAN);
    format!(
        "{:.1} +- {:.1} mm at {:.0} Hz, as responses correlate in space; {:.1} mm by the surface file",
        1e3 * of("estimated_m"),
        1e3 * of("error_m"),
        of("at_hz"),
        1e3 * of("of_file_m")
    )
}
