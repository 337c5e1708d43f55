//! Comparison of focusing methods on the same targets, on one surface or several.

use super::{Ask, FailedSurface, On, Report, compared, figure};
use crate::figures::Columns;
use crate::judge::{listening, reaches};
use crate::numbers::above_zero;
use crate::source::{self, Source};
use crate::target::targets;
use crate::window::{carries, conditions};
use crate::{Progress, TaskError, figures, folder, go_on};
use unripple::act::Level;
use unripple::focus::Target;
use unripple_plot::Figure;

/// Computes and evaluates the drive of every method on the same targets, on each surface; on one surface also the tradeoff curves of the
/// methods' parameters.
///
/// ```
/// use unripple_tasks::compare::{Ask, run};
/// use unripple_tasks::{Silent, SurfaceAsk, target};
///
/// // Two films that differ in tension, in a band narrow enough for an example.
/// let film = |tension: &str| {
///     let keys = [("sheet.tension_n_per_m", tension), ("drive.band_hz", "[0, 1000]")];
///     let set = keys.map(|(key, value)| (key.to_owned(), value.to_owned())).into();
///     SurfaceAsk::Set { name: "hudin-2012".into(), set }
/// };
/// let ask = Ask {
///     surface: film("200"),
///     others: vec![film("300")],
///     labels: vec!["200 N/m".into(), "300 N/m".into()],
///     points: vec![target::PointAsk::at(0.062, 0.09)],
///     ..Ask::default()
/// };
/// let report = run(&ask, &mut Silent)?;
/// let modes: Vec<usize> = report.surfaces().iter().map(|on| on.modes).collect();
/// assert!(modes[0] > modes[1], "a tighter film has fewer modes in the same band: {modes:?}");
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of reading and writing files; that of the first surface if all of them fail;
/// [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let sources = ask.all().map(|asked| source::open(asked, progress));
    let sources = sources.collect::<Result<Vec<Source>, TaskError>>()?;
    let (columns, labels) = (Columns::of(ask.columns)?, labels(ask, &sources)?);
    let unscaled = sources.iter().find_map(Source::without_scale);
    let level = ask.level.level_on(unscaled.as_deref())?;
    check(ask, &sources)?;
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let on = each(ask, sources, labels, level, progress)?;
    let mut found = Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "compare",
        on,
        files: Vec::new(),
        level,
    };
    if let Some((out, record)) = out {
        if let Some(drawn) = drawn(&found.on, ask) {
            found.files = figures::write(&out, &columns.fit(vec![("compare", drawn)]))?;
        }
        record.write(&out, &found)?;
        out.write("report.md", found.markdown().as_bytes())?;
        folder::finish(out, progress)?;
    }
    Ok(found)
}

/// Checks the request before any long computation. With several surfaces, targets are checked later on each
/// surface by itself.
fn check(ask: &Ask, sources: &[Source]) -> Result<(), TaskError> {
    let window = ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()?;
    listening(ask.listen_m)?;
    sources.iter().try_for_each(|source| source.allows(&[("judge_hz", ask.judge_hz.is_some())]))?;
    if let [source] = sources {
        let surface = &source.surface;
        reaches(surface, ask.judge_hz)?;
        let stored = source.stored.as_ref().map(|stored| stored.responses.conditions.clone());
        let conditions = stored.unwrap_or_else(|| conditions(surface));
        window.map_or(Ok(()), |window| carries(&conditions, window, "window_s"))?;
        let targets = targets(&ask.points, &ask.shapes, conditions.lambda_min)?;
        Target::check(&targets, &surface.outline).map_err(TaskError::input)?;
    }
    Ok(())
}

/// Name of each surface in the report: its label in the request, the name in its file, or the request's
/// name for it where two files have the same name.
fn labels(ask: &Ask, sources: &[Source]) -> Result<Vec<String>, TaskError> {
    let (given, count) = (ask.labels.len(), sources.len());
    let surfaces = || sources.iter().map(|source| &source.surface);
    if given == count {
        return Ok(ask.labels.clone());
    }
    if given > 0 {
        return Err(TaskError::ask("labels", format!("{count}, one for each surface"), given));
    }
    let is_shared = |name: &str| surfaces().filter(|surface| surface.name == name).count() > 1;
    let called = surfaces().zip(ask.all()).map(|(surface, asked)| match is_shared(&surface.name) {
        true => asked.to_string(),
        false => surface.name.clone(),
    });
    Ok(called.collect())
}

/// Compares the methods on each surface. If there are several, those that fail are listed with the reason,
/// and the others continue.
fn each(
    ask: &Ask,
    sources: Vec<Source>,
    labels: Vec<String>,
    level: Level,
    progress: &mut dyn Progress,
) -> Result<On, TaskError> {
    let (mut done, mut failed) = (Vec::new(), Vec::new());
    let alone = sources.len() == 1;
    for (source, label) in sources.into_iter().zip(labels) {
        go_on(progress)?;
        let of = if alone { String::new() } else { format!("{label}: ") };
        match compared::on(ask, source, level, (label.clone(), &of), progress) {
            Ok(on) if alone => return Ok(On::One(Box::new(on))),
            Ok(on) => done.push(on),
            Err(error) if alone || matches!(error, TaskError::Cancelled) => return Err(error),
            Err(error) => failed.push((label, error)),
        }
    }
    if done.is_empty() {
        return Err(first(failed));
    }
    let failed = failed.into_iter().map(|(label, error)| FailedSurface { label, why: error.to_string() });
    Ok(On::Several { surfaces: done, failed: failed.collect() })
}

/// The error of the first of the surfaces, all of which failed, with its name.
fn first(failed: Vec<(String, TaskError)>) -> TaskError {
    match failed.into_iter().next() {
        Some((label, TaskError::Input(text))) => TaskError::Input(format!("{label}: {text}")),
        Some((label, TaskError::Memory(text))) => TaskError::Memory(format!("{label}: {text}")),
        Some((label, TaskError::Work(text))) => TaskError::Work(format!("{label}: {text}")),
        Some((_, error)) => error,
        None => TaskError::ask("surface", "at least one surface", "none"),
    }
}

/// The figure of a report; `None` if the request excludes it, or if there is nothing to draw.
fn drawn(on: &On, ask: &Ask) -> Option<Figure> {
    match on {
        _ if ask.no_figures => None,
        On::One(_) if ask.no_tradeoffs => None,
        On::One(on) => Some(figure::draw(&on.methods, &on.fronts, &on.felt)),
        On::Several { surfaces, .. } => figure::beside(surfaces),
    }
}
