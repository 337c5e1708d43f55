//! One method of a comparison, and the table of all.

use super::ground::Ground;
use super::trade::{Trade, traded};
use crate::TaskError;
use serde::Serialize;
use std::fmt::Write;
use std::time::Instant;
use unripple::act::{Act, Level, Note, Strength};
use unripple::field::{DriveFigures, Measured, TargetFigures};
use unripple::focus::{Focuser, Method, Options};

/// Results of one method. The drive is emitted at the level asked for, or at the drive limit where that level is beyond
/// it.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Name of the method.
    pub method: &'static str,
    /// Time to prepare the method for the surface, in s.
    pub plan_s: f64,
    /// Time to compute the drive for the targets after that, in s.
    pub drive_s: f64,
    /// Drive energy for a given peak velocity at the first target, relative to time reversal (ratio).
    pub energy_for_peak: f64,
    /// Rms of the drive for a given felt level at the first target, relative to time reversal, in dB.
    pub drive_for_level_db: f64,
    /// Peak velocity at the first target at the drive limit, relative to time reversal (ratio).
    pub peak_at_limit: f64,
    /// Contrast at the first target at the drive limit (ratio).
    pub contrast_at_limit: f64,
    /// Figures of every target.
    pub targets: Vec<TargetFigures>,
    /// Figures of the drive.
    pub drive: DriveFigures,
    /// Strength of the drive compared with its limits.
    pub level: Strength,
    /// Notes on the drive.
    pub notes: Vec<Note>,
    /// Contrast, energy per squared peak, and peak, at the drive limit.
    #[serde(skip)]
    pub(super) trade: Trade,
}

/// Makes and evaluates the drive of one method.
pub fn judge(ground: &Ground<'_>, method: Method) -> Result<Row, TaskError> {
    with(ground, &Options { method, ..ground.options.clone() })
}

/// Computes and evaluates the drive that some options give.
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
    let Measured { targets, drive, .. } = field.measure(&sent.aims, sent.period).map_err(TaskError::input)?;
    Ok(Row {
        method: options.method.name(),
        plan_s,
        drive_s,
        energy_for_peak: 1.0,
        drive_for_level_db: 0.0,
        peak_at_limit,
        contrast_at_limit,
        targets,
        drive,
        level: sent.strength,
        notes,
        trade,
    })
}

/// Relates the energies, felt drives and peaks of all rows to those of the first row: ratios, and dB for the felt
/// drives.
pub fn relate(rows: &mut [Row]) {
    let first = rows.first().map_or([f64::NAN; 2], prices);
    let peak = rows.first().map_or(f64::NAN, |row| row.peak_at_limit);
    rows.iter_mut().for_each(|row| {
        let [energy, drive] = prices(row);
        row.peak_at_limit /= peak;
        (row.energy_for_peak, row.drive_for_level_db) = (energy / first[0], drive - first[1]);
    });
}

/// Energy per squared peak of the first target, and dB of drive rms per felt level.
fn prices(row: &Row) -> [f64; 2] {
    let target = row.targets.first();
    let peak = target.map_or(f64::NAN, |target| target.peak_velocity_m_s);
    let level = target.and_then(|target| target.felt_level_db).unwrap_or(f64::NAN);
    [row.drive.energy / (peak * peak), 20.0 * row.drive.rms.log10() - level]
}

/// Headings of the table's columns, in the order of `cells`.
const HEADINGS: [&str; 15] = [
    "method",
    "contrast",
    "background",
    "worst spot",
    "spot mm",
    "peak m/s",
    "energy for peak",
    "peak at limit",
    "felt dB",
    "felt contrast",
    "felt background",
    "felt worst",
    "drive for felt",
    "plan ms",
    "drive ms",
];

/// The cells of a row, of its first target.
fn cells(row: &Row) -> Vec<String> {
    let number = |x: Option<f64>, digits: usize| x.map_or("-".into(), |x| format!("{x:.digits$}"));
    let target = row.targets.first();
    let of = |figure: fn(&TargetFigures) -> Option<f64>| target.and_then(figure);
    vec![
        row.method.to_owned(),
        number(of(|t| t.contrast), 1),
        number(of(|t| t.background_contrast), 1),
        number(of(|t| t.worst_spot), 2),
        number(of(|t| t.spot_diameter_m.map(|d| d * 1e3)), 2),
        target.map_or("-".into(), |t| three(t.peak_velocity_m_s)),
        format!("{:.2}", row.energy_for_peak),
        three(row.peak_at_limit),
        number(of(|t| t.felt_level_db), 1),
        number(of(|t| t.felt_contrast_db), 1),
        number(of(|t| t.felt_background_db), 1),
        number(of(|t| t.felt_worst_spot_db), 1),
        format!("{:.1}", row.drive_for_level_db),
        format!("{:.1}", row.plan_s * 1e3),
        format!("{:.2}", row.drive_s * 1e3),
    ]
}

/// Three digits, as many as a level is worth.
fn three(value: f64) -> String {
    let digits = (2.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.digits$}")
}

/// The table of all methods, for a terminal.
pub fn table(rows: &[Row], conditions: Conditions) -> String {
    let mut text = format!("{conditions}\n\n");
    let all: Vec<Vec<String>> =
        std::iter::once(HEADINGS.map(String::from).to_vec()).chain(rows.iter().map(cells)).collect();
    for row in &all {
        for (i, cell) in row.iter().enumerate() {
            let width = all.iter().map(|row| row[i].len()).max().unwrap_or(0);
            let _ = match i {
                0 => write!(text, "{cell:<width$}"),
                _ => write!(text, "  {cell:>width$}"),
            };
        }
        text.push('\n');
    }
    for (row, note) in notes(rows) {
        let _ = write!(text, "\nnote ({}): {}", row.method, note.text);
    }
    text
}

fn notes(rows: &[Row]) -> impl Iterator<Item = (&Row, &Note)> {
    rows.iter().flat_map(|row| row.notes.iter().map(move |note| (row, note)))
}

/// The table of all methods, as Markdown.
pub fn markdown(surface: &str, rows: &[Row], conditions: Conditions) -> String {
    let mut text = format!("# {surface}: methods compared\n\n{conditions}\n\n");
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    text.push_str(&line(&HEADINGS.map(String::from)));
    text.push_str(&line(&HEADINGS.map(|_| "---".into())));
    rows.iter().for_each(|row| text.push_str(&line(&cells(row))));
    for (row, note) in notes(rows) {
        let _ = write!(text, "\n- **{}**: {}", row.method, note.text);
    }
    text.push('\n');
    text
}

/// Window, modes and level that all rows have in common.
#[derive(Clone, Copy, Debug)]
pub struct Conditions {
    /// Window T, in s.
    pub window: f64,
    /// Highest frequency of the modes that drives are evaluated on, in Hz.
    pub judged_to: f64,
    /// The level that was asked for.
    pub level: Level,
}

impl std::fmt::Display for Conditions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let level = match self.level {
            Level::Linear => "each as strong as linear theory and the drive limit allow".to_owned(),
            Level::Limit => "at the drive limit".to_owned(),
            Level::Peak(metres) => {
                format!("each moving it by {} µm if the drive limit lets it", three(metres * 1e6))
            }
            Level::Felt(db) => {
                format!("each felt there {db:.1} dB above threshold if the drive limit lets it")
            }
        };
        write!(
            f,
            "Window {} ms, first target, {level}, simulated with modes up to {:.0} Hz. Energy for the same peak and peak at \
             the drive limit are relative to time reversal's; felt: dB above threshold, and below the target's level; drive \
             for the same felt level in dB over time reversal's.",
            unripple::physics::design::milliseconds(self.window),
            self.judged_to
        )
    }
}
