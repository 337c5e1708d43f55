//! Libraries that are continued: new points are measured as those that are there already.

use super::ask::Ask;
use crate::TaskError;
use unripple::core::Surface;
use unripple_calibrate::measure::MeasureOptions;
use unripple_store::{Library, LibraryPlan};

/// The key of a plan's provenance for the seconds of a sweep.
pub const SWEEP: &str = "sweep s";
/// The key for its lowest and highest frequency, in Hz.
pub const SWEPT: &str = "swept Hz";

/// Frequencies that differ by less than this share are the same.
const SAME: f64 = 1e-9;

/// Sweeps as a library that is there was measured, where nothing else is asked for: what suits the surface may be another sweep by now, and
/// points of two sweeps do not go together.
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
                 does not: new points may not fit its own; measure into another library",
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

/// The sweep's length, and that of the responses.
fn rest(plan: &LibraryPlan, ask: &Ask, surface: &Surface, settings: &mut MeasureOptions) {
    let sweep = plan.provenance.get(SWEEP).and_then(|text| text.parse().ok());
    if let Some(sweep) = sweep.filter(|s: &f64| s.is_finite() && *s > 0.0 && ask.sweep_s.is_none()) {
        settings.sweep = sweep;
    }
    if ask.response_s.is_none() && plan.samples > 1 {
        settings.response_length = (plan.samples - 1) as f64 / surface.emission.rate;
    }
}
