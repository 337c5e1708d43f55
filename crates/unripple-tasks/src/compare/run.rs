//! Every method on the same targets.

use super::row::{self, Row};
use super::{Ask, Report, figure, front};
use crate::numbers::above_zero;
use crate::target::targets;
use crate::window::{carries, of_window};
use crate::{Progress, TaskError, figures, folder, go_on, judge};
use unripple::act::{Level, Readouts, chosen_window};
use unripple::core::{Responses, Surface};
use unripple::focus::{Method, Options, Target};
use unripple_store::OutputDir;

/// Everything that is compared with.
pub(super) struct Ground<'a> {
    /// The surface in common.
    pub surface: &'a Surface,
    /// Responses that drives are made from.
    pub known: &'a Responses,
    /// Responses that drives are evaluated on.
    pub plant: &'a Responses,
    /// What it takes to read that, made once for all of them.
    pub on: &'a Readouts<'a>,
    /// The targets in common.
    pub targets: &'a [Target],
    /// The options in common: window, level.
    pub options: &'a Options,
    /// How strongly each method drives.
    pub level: Level,
}

/// Options of all methods: the window (s) and the surface's limits.
fn settings(surface: &Surface, window: f64) -> Options {
    let (limit, rms_limit) = (surface.emission.limit, surface.emission.rms_limit);
    Options { window, limit, rms_limit, ..Options::default() }
}

/// The row of time reversal, which knobs are held against, before it is related to itself.
fn reversal(rows: &[Row]) -> Result<Row, TaskError> {
    let found = rows.iter().find(|row| row.method == Method::TimeReversal.name());
    found
        .cloned()
        .ok_or_else(|| TaskError::Work("time reversal: expected among the methods, found none".into()))
}

/// Makes and evaluates the drive of every method on the same targets, and what their knobs trade.
///
/// # Errors
/// [`TaskError::Ask`] of what makes no sense; those of reading and writing files; those of the methods; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    let out = ask.output.as_ref().map(|place| OutputDir::create_beside(place, &ask.reads())).transpose()?;
    go_on(progress)?;
    progress.stage("responses");
    let known = judge::model(&surface, None, &[])?;
    let targets = targets(&ask.points, &ask.shapes, known.conditions().lambda_min)?;
    let judged_to = ask.judge_hz.unwrap_or(2.0 * surface.emission.band[1]);
    let plant = judge::model(&surface, Some(judged_to), &[])?;
    let asked = ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()?;
    let chosen = asked.is_none().then(|| chosen_window(&surface, &known));
    let window = asked.or(chosen.as_ref().map(|chosen| chosen.seconds)).unwrap_or_default();
    carries(known.conditions(), window, "window_s")?;
    let settings = settings(&surface, window);
    let level = ask.level.level()?;
    let ground = Ground {
        surface: &surface,
        known: &known,
        plant: &plant,
        on: &Readouts::of(&plant),
        targets: &targets,
        options: &settings,
        level,
    };
    let mut rows = Vec::new();
    for method in Method::ALL {
        go_on(progress)?;
        progress.stage(method.name());
        rows.push(row::judge(&ground, method).map_err(|error| of_window(error, asked.is_some()))?);
    }
    let reversal = reversal(&rows)?;
    row::relate(&mut rows);
    let fronts = front::all(&ground, reversal.trade, progress)?;
    let felt = front::felt(&ground, reversal, progress)?;

    let mut found = Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "compare",
        surface: surface.name.clone(),
        window_s: window,
        window_why: chosen.as_ref().map(|chosen| chosen.why.clone()),
        judged_to_hz: judged_to,
        methods: rows,
        fronts,
        felt,
        files: Vec::new(),
        level,
        window_text: chosen.map(|chosen| chosen.text()),
    };
    if let Some(out) = out {
        let drawn = figure::draw(&found.methods, &found.fronts, &found.felt);
        found.files = figures::write(&out, &[("compare", drawn)])?;
        out.write("report.json", folder::json(&found)?.as_bytes())?;
        let page = row::markdown(&found.surface, &found.methods, found.conditions());
        out.write("report.md", page.as_bytes())?;
        folder::finish(out, progress)?;
    }
    Ok(found)
}
