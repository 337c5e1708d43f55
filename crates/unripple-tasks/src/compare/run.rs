//! Comparison of all focusing methods on the same targets.

use super::failed::survived;
use super::ground::Ground;
use super::row::{self, Row};
use super::{Ask, Failed, Report, figure, front};
use crate::figures::Columns;
use crate::numbers::above_zero;
use crate::target::targets;
use crate::window::{carries, of_window};
use crate::{Progress, TaskError, figures, folder, go_on, judge};
use unripple::act::{Readouts, chosen_window};
use unripple::core::Surface;
use unripple::focus::{Method, Options};

/// Options of all methods: the window (s) and the surface's limits.
fn settings(surface: &Surface, window: f64) -> Options {
    let (limit, rms_limit) = (surface.emission.limit, surface.emission.rms_limit);
    Options { window, limit, rms_limit, ..Options::default() }
}

/// The row of time reversal, to which tradeoff curves are related, as it is before it is divided by itself.
fn reversal(rows: &[Row]) -> Result<Row, TaskError> {
    let found = rows.iter().find(|row| row.method == Method::TimeReversal.name());
    found
        .cloned()
        .ok_or_else(|| TaskError::Work("time reversal: expected among the methods, found none".into()))
}

/// The row of every method, time reversal first, and the methods that failed; errors say whether the window was asked for.
fn rows(
    ground: &Ground<'_>,
    asked: bool,
    progress: &mut dyn Progress,
) -> Result<(Vec<Row>, Vec<Failed>), TaskError> {
    let (mut rows, mut failed) = (Vec::new(), Vec::new());
    for method in Method::ALL {
        go_on(progress)?;
        progress.stage(method.name());
        match row::judge(ground, method).map_err(|error| of_window(error, asked)) {
            // All others are held against it.
            Err(error) if method == Method::TimeReversal => return Err(error),
            judged => rows.extend(survived(judged, method, &mut failed)?),
        }
    }
    Ok((rows, failed))
}

/// Computes and evaluates the drive of every method on the same targets, and the tradeoff curves of the methods' parameters.
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of reading and writing files; those of the methods; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let columns = Columns::of(ask.columns)?;
    let surface = ask.surface.load()?;
    let out = folder::begin(ask.output.as_deref(), ask)?;
    go_on(progress)?;
    progress.stage("responses");
    let known = judge::model(&surface, None, &[])?;
    let targets = targets(&ask.points, &ask.shapes, known.conditions().lambda_min)?;
    let judged_to = ask.judge_hz.unwrap_or_else(|| judge::judged_hz(&surface, judge::JUDGED_BANDS));
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
    let (mut rows, mut failed) = rows(&ground, asked.is_some(), progress)?;
    let reversal = reversal(&rows)?;
    row::relate(&mut rows);
    let (fronts, felt) = match ask.no_tradeoffs {
        true => (Vec::new(), Vec::new()),
        false => front::both(&ground, reversal, &mut failed, progress)?,
    };

    let mut found = Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "compare",
        surface: surface.name.clone(),
        window_s: window,
        window_why: chosen.as_ref().map(|chosen| chosen.why.clone()),
        judged_to_hz: judged_to,
        methods: rows,
        failed,
        fronts,
        felt,
        files: Vec::new(),
        level,
        window_text: chosen.map(|chosen| chosen.text()),
    };
    if let Some((out, record)) = out {
        if !(ask.no_figures || ask.no_tradeoffs) {
            let drawn = figure::draw(&found.methods, &found.fronts, &found.felt);
            found.files = figures::write(&out, &columns.fit(vec![("compare", drawn)]))?;
        }
        record.write(&out, &found)?;
        let page = found.markdown();
        out.write("report.md", page.as_bytes())?;
        folder::finish(out, progress)?;
    }
    Ok(found)
}
