use super::Ground;
use crate::error::CliError;
use crate::judge::CELLS;
use serde::Serialize;
use std::fmt::Write;
use std::time::Instant;
use unripple::field::{Aim, DriveFigures, Field, Measured, TargetFigures};
use unripple::focus::{Focused, Focuser, Method, Options};

/// What one method does, as emitted at the drive limit.
#[derive(Debug, Serialize)]
pub struct Row {
    pub method: &'static str,
    /// Seconds to plan for the surface, and for the drive of these targets after that.
    pub plan_s: f64,
    pub drive_s: f64,
    /// Energy that the peak velocity of the first target takes, over that of time reversal.
    pub energy_for_peak: f64,
    /// Rms of the drive that the felt level of the first target takes, over that of time reversal, in dB.
    pub drive_for_level_db: f64,
    pub targets: Vec<TargetFigures>,
    pub drive: DriveFigures,
}

/// Makes and judges the drive of one method.
pub fn judge(ground: &Ground<'_>, method: Method) -> Result<Row, CliError> {
    with(ground, &Options { method, ..ground.options.clone() })
}

/// Makes and judges the drive of some options.
pub fn with(ground: &Ground<'_>, options: &Options) -> Result<Row, CliError> {
    let start = Instant::now();
    let focuser = Focuser::new(ground.known, options).map_err(CliError::input)?;
    let plan_s = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let focused = focuser.focus(ground.targets).map_err(CliError::input)?;
    let drive_s = start.elapsed().as_secs_f64();
    let Measured { targets, drive, .. } = measured(ground, &focused)?;
    let (energy_for_peak, drive_for_level_db) = (1.0, 0.0);
    let method = options.method.name();
    Ok(Row { method, plan_s, drive_s, energy_for_peak, drive_for_level_db, targets, drive })
}

fn measured(ground: &Ground<'_>, focused: &Focused) -> Result<Measured, CliError> {
    let drive = focused.drive.clone().as_emitted();
    let seconds = |samples: usize| samples as f64 / drive.rate();
    let aims: Vec<Aim> = ground
        .targets
        .iter()
        .zip(&focused.timing)
        .map(|(target, timing)| Aim { points: target.points.clone(), instant: seconds(timing.instant) })
        .collect();
    let field = Field::new(ground.plant, &drive, CELLS).map_err(CliError::input)?;
    field.measure(&aims, focused.period.map(seconds)).map_err(CliError::input)
}

/// Energies for the same peak, and drives for the same felt level, over those of the first row.
pub fn relate(rows: &mut [Row]) {
    let first = rows.first().map_or([f64::NAN; 2], prices);
    rows.iter_mut().for_each(|row| {
        let [energy, drive] = prices(row);
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

const HEADINGS: [&str; 14] = [
    "method",
    "contrast",
    "background",
    "worst spot",
    "spot mm",
    "peak m/s",
    "energy for peak",
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
        number(of(|t| Some(t.peak_velocity_m_s)), 1),
        format!("{:.2}", row.energy_for_peak),
        number(of(|t| t.felt_level_db), 1),
        number(of(|t| t.felt_contrast_db), 1),
        number(of(|t| t.felt_background_db), 1),
        number(of(|t| t.felt_worst_spot_db), 1),
        format!("{:.1}", row.drive_for_level_db),
        format!("{:.1}", row.plan_s * 1e3),
        format!("{:.2}", row.drive_s * 1e3),
    ]
}

/// For a terminal.
pub fn table(rows: &[Row], window: f64, judged_to: f64) -> String {
    let mut text = format!("{}\n\n", conditions(window, judged_to));
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
    text
}

/// For a page.
pub fn markdown(surface: &str, rows: &[Row], window: f64, judged_to: f64) -> String {
    let mut text = format!("# {surface}: methods compared\n\n{}\n\n", conditions(window, judged_to));
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    text.push_str(&line(&HEADINGS.map(String::from)));
    text.push_str(&line(&HEADINGS.map(|_| "---".into())));
    rows.iter().for_each(|row| text.push_str(&line(&cells(row))));
    text.push_str("\n![Contrast against energy, and against the peak at the drive limit](compare.png)\n");
    text
}

fn conditions(window: f64, judged_to: f64) -> String {
    format!(
        "Window {:.1} ms, first target, at the drive limit, judged on modes to {judged_to:.0} Hz. Energy for the same peak is relative \
         to time reversal's; felt: dB above threshold, and below the target's level; drive for the same felt level in \
         dB over time reversal's.",
        window * 1e3
    )
}
