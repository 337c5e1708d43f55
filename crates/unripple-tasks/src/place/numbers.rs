//! Checks of the numbers of a request that need no surface.

use super::Ask;
use crate::TaskError;
use crate::areas::{from_rim, polygons};
use crate::numbers::above_zero;
use crate::sweep::short;

/// Largest number of actuators, of targets, and of layouts that are evaluated one by one. More are taken for a mistake.
const MOST: usize = 1000;

/// Checks the numbers of a request that need no surface.
pub(super) fn numbers(ask: &Ask) -> Result<(), TaskError> {
    let within = |field: &'static str, found: usize, least: usize| match (least..=MOST).contains(&found) {
        true => Ok(()),
        false => Err(TaskError::ask(field, format!("{least} to {MOST}"), found)),
    };
    within("count", ask.count, 1)?;
    within("targets", ask.targets, 1)?;
    within("restarts", ask.restarts, 0)?;
    within("up_to", ask.up_to.unwrap_or(1), 1)?;
    within("evaluations", ask.evaluations.unwrap_or(1), 1)?;
    if ask.evaluations.is_some() && ask.by.is_none() {
        return Err(TaskError::ask(
            "evaluations",
            "a figure that layouts are compared by, as `by` names it",
            "none",
        ));
    }
    let share = |field: &'static str, found: f64, most: f64| match (0.0..=most).contains(&found) {
        true => Ok(()),
        false => {
            let expected = format!("a share from 0 to {} %", short(100.0 * most));
            Err(TaskError::ask(field, expected, format!("{} %", short(100.0 * found))))
        }
    };
    let length = |field: &'static str, found: f64| match (0.0..=1.0).contains(&found) {
        true => Ok(()),
        false => Err(TaskError::ask(field, "a length from 0 to 1000 mm", format!("{} mm", 1e3 * found))),
    };
    share("share", ask.share, 1.0)?;
    share("tension", ask.tension, 0.5)?;
    // Beyond a metre, errors and distances are taken for mistakes of unit.
    length("mounting_m", ask.mounting_m)?;
    length("apart_m", ask.apart_m.unwrap_or(0.0))?;
    ask.pitch_m.map_or(Ok(1.0), |pitch| above_zero(pitch, "pitch_m", "m"))?;
    from_rim(ask.rim_m)?;
    if !(ask.weights.is_empty() || ask.weights.len() == ask.points_m.len()) {
        let expected = format!("{}, one for each of `points_m`", ask.points_m.len());
        return Err(TaskError::ask("weights", expected, ask.weights.len()));
    }
    if let Some(weight) = ask.weights.iter().find(|weight| !(weight.is_finite() && **weight > 0.0)) {
        return Err(TaskError::ask("weights", "numbers above 0", weight));
    }
    for (field, areas) in [
        ("within_m", &ask.within_m),
        ("keep_out_m", &ask.keep_out_m),
        ("targets_within_m", &ask.targets_within_m),
    ] {
        polygons(field, areas)?;
    }
    Ok(())
}
