//! What turning a method's knob gives.

use super::row::{self, Row};
use super::run::Ground;
use crate::{Progress, TaskError, go_on};
use serde::Serialize;
use unripple::focus::{Focused, Focuser, Method, Options};

/// What turning a method's knob gives, point by point.
#[derive(Clone, Debug, Serialize)]
pub struct Front {
    /// Name of the method.
    pub method: &'static str,
    /// `strength` or `push`.
    pub knob: &'static str,
    /// Values of the knob.
    pub at: Vec<f64>,
    /// Contrast at the first target and its focal instant.
    pub contrast: Vec<f64>,
    /// Energy for the same peak, over time reversal's.
    pub energy_for_peak: Vec<f64>,
    /// Peak velocity at the drive limit, over time reversal's.
    pub peak: Vec<f64>,
}

/// Strengths at which a method is tried, closer where it is near its own limit and contrast changes fastest.
const STRENGTHS: [f64; 7] = [0.0, 0.3, 0.6, 0.8, 0.9, 0.96, 0.99];
/// The same for `robust`, fewer, since planning for several plants takes its time.
const ROBUST: [f64; 4] = [0.0, 0.7, 0.95, 0.99];
/// Of `felt`: weights of energy, and of the worst spot that goes with each.
const ECONOMIES: [[f64; 2]; 5] = [[0.01, 0.04], [0.06, 0.04], [0.2, 0.05], [0.5, 0.06], [1.5, 0.08]];
const PUSHES: [f64; 6] = [0.1, 0.3, 0.5, 0.7, 0.85, 0.95];

/// Contrast, energy per squared peak, peak.
pub(super) type Trade = [f64; 3];

/// What is felt elsewhere against the drive that it takes: one row per weight of energy, the first that of time reversal.
pub(super) fn felt(
    ground: &Ground<'_>,
    reversal: Row,
    progress: &mut dyn Progress,
) -> Result<Vec<Row>, TaskError> {
    let mut rows = vec![reversal];
    for [economy, worst] in ECONOMIES {
        go_on(progress)?;
        rows.push(row::with(
            ground,
            &Options { method: Method::Felt, economy, worst, ..ground.options.clone() },
        )?);
    }
    row::relate(&mut rows);
    Ok(rows)
}

/// The fronts of all methods that have a knob, against what time reversal trades.
pub(super) fn all(
    ground: &Ground<'_>,
    reversal: Trade,
    progress: &mut dyn Progress,
) -> Result<Vec<Front>, TaskError> {
    progress.stage("the tradeoffs of the methods' parameters");
    let strong = |method, values: &[f64]| front(ground, reversal, method, "strength", values, progress);
    Ok(vec![
        strong(Method::Inverse, &STRENGTHS)?,
        strong(Method::Concentrate, &STRENGTHS)?,
        strong(Method::Robust, &ROBUST)?,
        front(ground, reversal, Method::Limited, "push", &PUSHES, progress)?,
    ])
}

fn front(
    ground: &Ground<'_>,
    reversal: Trade,
    method: Method,
    knob: &'static str,
    values: &[f64],
    progress: &dyn Progress,
) -> Result<Front, TaskError> {
    let found = values.iter().map(|value| {
        go_on(progress)?;
        let mut options = Options { method, ..ground.options.clone() };
        match method {
            Method::Limited => options.push = *value,
            _ => options.strength = Some(*value),
        }
        trade(ground, &options)
    });
    let found = found.collect::<Result<Vec<Trade>, TaskError>>()?;
    let of = |i: usize, unit: f64| found.iter().map(|trade| trade[i] / unit).collect();
    Ok(Front {
        method: method.name(),
        knob,
        at: values.to_vec(),
        contrast: of(0, 1.0),
        energy_for_peak: of(1, reversal[1]),
        peak: of(2, reversal[2]),
    })
}

fn trade(ground: &Ground<'_>, options: &Options) -> Result<Trade, TaskError> {
    let focuser = Focuser::new(ground.known, options).map_err(TaskError::input)?;
    let focused = focuser.focus(ground.targets).map_err(TaskError::input)?;
    traded(ground, &focused)
}

/// What a drive trades at the first target and its focal instant.
pub(super) fn traded(ground: &Ground<'_>, focused: &Focused) -> Result<Trade, TaskError> {
    let drive = focused.drive.clone().as_emitted();
    let field = ground.on.coarse()?.field(&drive).map_err(TaskError::input)?;
    let places: Vec<_> = ground.targets.iter().flat_map(|target| target.points.iter().copied()).collect();
    let found =
        field.at_instant(focused.instant(), &ground.targets[0].points, &places).map_err(TaskError::input)?;
    let peak = found.velocity.abs();
    Ok([peak / found.rms_outside, drive.energy() / (peak * peak), peak])
}
