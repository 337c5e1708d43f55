//! Settings of libraries that are continued: new points are measured with the settings of the points that are there already.

use super::ask::Ask;
use crate::TaskError;
use unripple::core::Surface;
use unripple_calibrate::measure::MeasureOptions;
use unripple_store::{Library, LibraryPlan};

/// Key in the provenance of a library's plan: the length of a sweep, in s.
pub const SWEEP: &str = "sweep s";
/// Key in the provenance of a library's plan: the lowest and highest frequency of a sweep, in Hz.
pub const SWEPT: &str = "swept Hz";

/// Relative difference below which two frequencies count as the same.
const SAME: f64 = 1e-9;

/// Takes over the sweep settings of a library that is continued, where the request does not specify them:
/// the defaults for the surface may have changed since, and points measured with different sweeps must not
/// be mixed.
pub fn apply(ask: &Ask, surface: &Surface, settings: &mut MeasureOptions) -> Result<(), TaskError> {
    if !Library::is_at(&ask.output) {
        return Ok(());
    }
    let library = Library::open(&ask.output)?;
    let plan = library.plan();
    let Some(text) = plan.provenance.get(SWEPT) else {
        // What is no measurement is refused for what it is.
        return match plan.provenance.contains_key(SWEEP) {
            true => Err(TaskError::Work(format!(
                "{}: expected a library that records the band of its sweeps (`{SWEPT}`), found one of an earlier version that \
                 does not: new points may not match those that are there; measure into another library",
                library.path().display()
            ))),
            false => Ok(()),
        };
    };
    let to = settings.swept(surface)[1];
    let hz: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    // A library of another band, or of no sweep, is refused by what else its plan says.
    if let [low, high] = hz[..]
        && low > 0.0
        && low < high
        && (high - to).abs() <= SAME * to
    {
        settings.start_hz = low;
        rest(plan, ask, surface, settings);
    }
    Ok(())
}

/// Takes over the length of the sweep and of the responses.
fn rest(plan: &LibraryPlan, ask: &Ask, surface: &Surface, settings: &mut MeasureOptions) {
    let sweep = plan.provenance.get(SWEEP).and_then(|text| text.parse().ok());
    if let Some(sweep) = sweep.filter(|s: &f64| s.is_finite() && *s > 0.0 && ask.sweep_s.is_none()) {
        settings.sweep = sweep;
    }
    if ask.response_s.is_none() && plan.samples > 1 {
        settings.response_length = (plan.samples - 1) as f64 / surface.emission.rate;
    }
}
