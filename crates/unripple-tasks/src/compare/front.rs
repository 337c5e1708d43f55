//! Tradeoff curves of the focusing methods: contrast, energy and peak as a parameter of the method varies.

use super::failed::{Failed, survived};
use super::ground::Ground;
use super::row::{self, Row};
use super::trade::{Trade, traded};
use crate::{Progress, TaskError, go_on};
use serde::Serialize;
use unripple::focus::{Focuser, Method, Options};

/// Tradeoff curve of a focusing method: metrics at each value of one of its parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Front {
    /// Name of the method.
    pub method: &'static str,
    /// Name of the parameter: `strength` or `push`.
    pub knob: &'static str,
    /// Values of the parameter, one for each point of the curve.
    pub at: Vec<f64>,
    /// Contrast at the first target and its focal instant.
    pub contrast: Vec<f64>,
    /// Drive energy for a given peak velocity, relative to time reversal (ratio).
    pub energy_for_peak: Vec<f64>,
    /// Peak velocity at the drive limit, relative to time reversal (ratio).
    pub peak: Vec<f64>,
}

/// Values of `strength` at which a method is evaluated, closer together near 1, where contrast changes
/// fastest.
const STRENGTHS: [f64; 7] = [0.0, 0.3, 0.6, 0.8, 0.9, 0.96, 0.99];
/// Values of `strength` at which `robust` is evaluated: fewer, since planning for several states of the
/// surface takes time.
const ROBUST: [f64; 4] = [0.0, 0.7, 0.95, 0.99];
/// Parameters at which `felt` is evaluated: `economy`, the weight of energy, and the weight `worst` of the
/// worst spot that goes with it.
const ECONOMIES: [[f64; 2]; 5] = [[0.01, 0.04], [0.06, 0.04], [0.2, 0.05], [0.5, 0.06], [1.5, 0.08]];
const PUSHES: [f64; 6] = [0.1, 0.3, 0.5, 0.7, 0.85, 0.95];

/// The tradeoff curves of those methods among `rows` that have a parameter, and the rows of `felt` for
/// increasing weights of energy.
pub(super) fn both(
    ground: &Ground<'_>,
    rows: &[Row],
    reversal: Row,
    failed: &mut Vec<Failed>,
    progress: &mut dyn Progress,
) -> Result<(Vec<Front>, Vec<Row>), TaskError> {
    // What was not asked for has no row, and what fails with its default would be told twice.
    let has_row = |method: Method| rows.iter().any(|row| row.method == method.name());
    let fronts = all(ground, has_row, reversal.trade, failed, progress)?;
    let felt = match has_row(Method::Felt) {
        true => felt(ground, reversal, failed, progress)?,
        false => vec![reversal],
    };
    Ok((fronts, felt))
}

/// The row of time reversal, followed by rows of `felt` for increasing weights of energy: level felt
/// outside the target against the drive.
fn felt(
    ground: &Ground<'_>,
    reversal: Row,
    failed: &mut Vec<Failed>,
    progress: &mut dyn Progress,
) -> Result<Vec<Row>, TaskError> {
    let mut rows = vec![reversal];
    for [economy, worst] in ECONOMIES {
        go_on(progress)?;
        let options = Options { method: Method::Felt, economy, worst, ..ground.options.clone() };
        rows.extend(survived(row::with(ground, &options), Method::Felt, failed)?);
    }
    row::relate(&mut rows);
    Ok(rows)
}

/// The tradeoff curves of all methods that have a row and a parameter, relative to time reversal.
fn all(
    ground: &Ground<'_>,
    has_row: impl Fn(Method) -> bool,
    reversal: Trade,
    failed: &mut Vec<Failed>,
    progress: &mut dyn Progress,
) -> Result<Vec<Front>, TaskError> {
    const KNOBS: [(Method, &str, &[f64]); 4] = [
        (Method::Inverse, "strength", &STRENGTHS),
        (Method::Concentrate, "strength", &STRENGTHS),
        (Method::Robust, "strength", &ROBUST),
        (Method::Limited, "push", &PUSHES),
    ];
    progress.stage("the tradeoffs of the methods' parameters");
    let mut fronts = Vec::new();
    for (method, knob, values) in KNOBS.into_iter().filter(|(method, ..)| has_row(*method)) {
        let found = front(ground, reversal, method, knob, values, progress);
        fronts.extend(survived(found, method, failed)?);
    }
    Ok(fronts)
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
        trade(ground, &options).map_err(|error| at(error, knob, *value))
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

/// Adds to an error the value of the parameter at which it occurred.
fn at(error: TaskError, knob: &str, value: f64) -> TaskError {
    match error {
        TaskError::Cancelled => TaskError::Cancelled,
        error => TaskError::Work(format!("{knob} {value}: {error}")),
    }
}

fn trade(ground: &Ground<'_>, options: &Options) -> Result<Trade, TaskError> {
    let focuser = Focuser::new(ground.known, options).map_err(TaskError::input)?;
    let focused = focuser.focus(ground.targets).map_err(TaskError::input)?;
    traded(ground, &focused)
}
