//! One method of a comparison on one surface.

use super::ground::Ground;
use super::trade::{Trade, traded};
use crate::TaskError;
use serde::Serialize;
use unripple::act::{Act, Note, Sound, Strength, power, ratios_of};
use unripple::core::clock::Instant;
use unripple::field::{DriveFigures, Measured, TargetFigures};
use unripple::focus::{Focuser, Method, Options};

/// Results of one method. Its drive has the requested level, or is at the drive limit if that level exceeds
/// the limit.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Name of the method.
    pub method: &'static str,
    /// Time to prepare the method for the surface, in s.
    pub plan_s: f64,
    /// Time to compute the drive for the targets once the method is prepared, in s.
    pub drive_s: f64,
    /// Drive energy for a given peak velocity at the first target, relative to time reversal (ratio).
    pub energy_for_peak: f64,
    /// Rms of the drive for a given felt level at the first target, relative to time reversal, in dB.
    pub drive_for_level_db: f64,
    /// Peak velocity at the first target at the drive limit, relative to time reversal (ratio).
    pub peak_at_limit: f64,
    /// Contrast at the first target at the drive limit (ratio).
    pub contrast_at_limit: f64,
    /// Metrics of every target.
    pub targets: Vec<TargetFigures>,
    /// Metrics of the drive.
    pub drive: DriveFigures,
    /// Mean mechanical power that the actuators give to the sheet, in W, over the whole drive or its last period.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_mechanical_power_w: Option<f64>,
    /// Sound pressure level above the surface.
    pub sound: Sound,
    /// Level of the drive relative to its limits.
    pub level: Strength,
    /// Notes on the drive.
    pub notes: Vec<Note>,
    /// Contrast, energy per squared peak, and peak, at the drive limit.
    #[serde(skip)]
    pub(super) trade: Trade,
}

/// Computes and evaluates the drive of one method.
pub fn judge(ground: &Ground<'_>, method: Method) -> Result<Row, TaskError> {
    with(ground, &Options { method, ..ground.options.clone() })
}

/// Computes and evaluates the drive for `options`, which include the method.
pub fn with(ground: &Ground<'_>, options: &Options) -> Result<Row, TaskError> {
    let start = Instant::now();
    let focuser = Focuser::new(ground.known, options).map_err(TaskError::input)?;
    let plan_s = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let focused = focuser.focus(ground.targets).map_err(TaskError::input)?;
    let drive_s = start.elapsed().as_secs_f64();
    let trade = traded(ground, &focused)?;
    let [contrast_at_limit, _, peak_at_limit] = trade;
    let Ground { surface, plant: responses, on, targets, level, .. } = *ground;
    let act = Act { surface, responses, targets, options, level };
    let sent = act.send_at_most(&focuser, focused, on)?;
    let notes = act.notes(&sent);
    let field = on.fine()?.field(&sent.drive).map_err(TaskError::input)?;
    let Measured { targets, drive: figures, .. } =
        field.measure(&sent.aims, sent.period).map_err(TaskError::input)?;
    let mean_mechanical_power_w = power(surface, &field, figures.duration_s)?;
    let sound = on.hearing(surface)?.sound(&sent.drive, sent.period)?;
    Ok(Row {
        method: options.method.name(),
        plan_s,
        drive_s,
        energy_for_peak: 1.0,
        drive_for_level_db: 0.0,
        peak_at_limit,
        contrast_at_limit,
        targets,
        drive: figures,
        mean_mechanical_power_w,
        sound,
        level: sent.strength,
        notes,
        trade,
    })
}

impl Row {
    /// This row without absolute displacements, velocities and levels, for responses without a known scale.
    pub fn without_scale(self) -> Self {
        Self {
            targets: self.targets.into_iter().map(ratios_of).collect(),
            mean_mechanical_power_w: None,
            sound: self.sound.without_scale(),
            level: self.level.allowing(None),
            ..self
        }
    }
}

/// Relates the energies, drives for a felt level, and peaks of all rows to those of the first row: as
/// ratios, and in dB for the drives.
pub fn relate(rows: &mut [Row]) {
    let first = rows.first().map_or([f64::NAN; 2], prices);
    let peak = rows.first().map_or(f64::NAN, |row| row.peak_at_limit);
    rows.iter_mut().for_each(|row| {
        let [energy, drive] = prices(row);
        row.peak_at_limit /= peak;
        (row.energy_for_peak, row.drive_for_level_db) = (energy / first[0], drive - first[1]);
    });
}

/// Energy per squared peak velocity at the first target, and rms of the drive relative to the felt level,
/// in dB.
fn prices(row: &Row) -> [f64; 2] {
    let target = row.targets.first();
    let peak = target.map_or(f64::NAN, |target| target.peak_velocity_m_s);
    let level = target.and_then(|target| target.felt_level_db).unwrap_or(f64::NAN);
    [row.drive.energy / (peak * peak), 20.0 * row.drive.rms.log10() - level]
}
