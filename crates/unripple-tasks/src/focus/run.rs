//! Computes a drive that focuses, and evaluates it.

use super::check::{lasts, possible};
use super::{Ask, Losses, Made, Report, write};
use crate::figures::Columns;
use crate::numbers::above_zero;
use crate::target::targets;
use crate::window::{carries, of_window};
use crate::{Progress, Solved, Source, TaskError, cost, fingers, folder, go_on, judge, source};
use unripple::act::{self, Act, Aware, Note};
use unripple::core::{Decay, Responses, Surface};
use unripple::focus::{LossCorrection, Method, Options};

/// Computes a drive that focuses on points and shapes, evaluates it, and writes it to a folder if the
/// request names one.
///
/// ```
/// use unripple_tasks::target::PointAsk;
/// use unripple_tasks::{Silent, focus};
///
/// let ask = focus::Ask { points: vec![PointAsk::at(0.062, 0.09)], ..focus::Ask::default() };
/// let report = focus::run(&ask, &mut Silent)?;
/// assert!(report.targets[0].contrast.is_some_and(|contrast| contrast > 20.0));
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of reading surfaces and drawings and of writing the folder; those of the
/// methods; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    kept(ask, |progress| source::open(&ask.surface, progress), progress)
}

/// Does what [`run()`] does, but on the surface or responses in `source` instead of those that the request
/// names; the record in the output folder contains the request.
///
/// # Errors
/// Those of [`run()`], but for those of reading them.
pub fn run_on(ask: &Ask, source: Source, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    kept(ask, |_| Ok(source), progress)
}

/// Computes and evaluates a drive on the surface or responses that `open` returns, and writes it to a
/// folder if the request names one.
fn kept(
    ask: &Ask,
    open: impl FnOnce(&mut dyn Progress) -> Result<Source, TaskError>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    let drawn = (!ask.no_figures).then_some(Columns::of(ask.columns)?);
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let mut made = make_on(ask, open(progress)?, progress)?;
    if let Some((out, record)) = out {
        progress.stage("figures");
        write::write(&out, &mut made, &record, drawn)?;
        folder::finish(out, progress)?;
    }
    Ok(made.report)
}

/// Computes and evaluates a drive as [`run()`] does, but returns all data and writes no folder.
///
/// # Errors
/// Those of [`run()`], except the errors of writing files.
pub fn make(ask: &Ask, progress: &mut dyn Progress) -> Result<Made, TaskError> {
    make_on(ask, source::open(&ask.surface, progress)?, progress)
}

/// Computes and evaluates a drive as [`make()`] does, but for the surface or responses in `source` instead
/// of those that the request names.
///
/// # Errors
/// Those of [`make()`], except the errors of reading the surface or responses.
pub fn make_on(ask: &Ask, source: Source, progress: &mut dyn Progress) -> Result<Made, TaskError> {
    source.allows(&needing_modes(ask))?;
    let plant = ask.on.as_ref().map(|on| on.load()).transpose()?;
    go_on(progress)?;
    let unscaled = source.without_scale().filter(|_| plant.is_none());
    let solved = source.solved.clone();
    let targets = targets(&ask.points, &ask.shapes, source.shortest_wavelength())?;
    if source.lambda_min().is_none() {
        lasts(ask, &source.surface)?;
    }
    possible(ask, &source.surface, plant.as_ref().unwrap_or(&source.surface), &targets)?;
    let level = ask.level.level_on(unscaled.as_deref())?;
    let places: Vec<_> = targets.iter().flat_map(|target| target.points.iter().copied()).collect();
    announce(ask, &source, plant.as_ref(), progress);
    progress.stage("responses");
    let (surface, responses, stored) = source.respond(&places, ask.between)?;
    let (window, why) = window(ask, (&surface, &responses), &solved, progress)?;
    let settings = settings(ask, &surface, window)?;
    let aware = aware(ask, &surface)?;
    go_on(progress)?;
    progress.stage("drive");
    let focuser = aware.focuser(&responses, &settings)?;
    let focused = focuser.focus(&targets).map_err(act::ActError::from);
    let focused = focused.map_err(|error| of_window(error.into(), ask.window_s.is_some()))?;
    let restored = aware.note(&responses, &targets, &settings, &focused)?;
    go_on(progress)?;
    let judged_surface = plant.as_ref().unwrap_or(&surface);
    let contacts = fingers::contacts(&ask.fingers_m, "fingers_m", judged_surface)?;
    progress.stage(judge::RESPONSES);
    // A library is evaluated on itself.
    let models = || judge::models(judged_surface, ask.judge_hz, &contacts, &solved);
    let models = (plant.is_some() || stored.is_none()).then(models).transpose()?;
    let free = models.as_ref().map_or(&responses, |(models, _)| &models.free);
    let under = models.as_ref().and_then(|(models, _)| models.under.as_ref()).unwrap_or(free);
    let act = Act { surface: judged_surface, responses: under, targets: &targets, options: &settings, level };
    let on = act.readouts().heard_at(judge::listening(ask.listen_m)?);
    go_on(progress)?;
    progress.stage("level");
    let sent = act.send(&focuser, focused, &on)?;
    go_on(progress)?;
    progress.stage("evaluation");
    let judged = judge::seen(sent.until, progress, || act.judge(&sent, &on))?;
    let (focused, drive) = (sent.focused, sent.drive);
    let mut report = Report::of_focus(&surface, &focused, settings.window, &drive, &judged);
    (report.level, report.response_error) =
        (Some(sent.strength), act::response_error(under, settings.window));
    report.fingers = act::felt(&contacts, judged_surface, [under, free], &drive, sent.until)?;
    report.notes.extend(why.into_iter().chain(restored));
    models.iter().for_each(|(_, judging)| judging.tell(judged_surface, &mut report));
    stored.into_iter().for_each(|of| tell_of_library(&mut report, of, act::nearby(&focused, &targets)));
    if unscaled.is_some() {
        report = report.without_scale();
    }
    let surface = judged_surface.clone();
    drop(focuser);
    Ok(Made { report, drive, judged, focused, surface, responses, scaled: unscaled.is_none() })
}

/// Tells what the drive will cost, unless its responses are at hand. What cannot be estimated is refused where it is computed.
fn announce(ask: &Ask, source: &Source, plant: Option<&Surface>, progress: &mut dyn Progress) {
    if source.stored.is_some() || source.computed.is_some() || source.solved.knows(&source.surface) {
        return;
    }
    let judged = plant.unwrap_or(&source.surface);
    let estimate = || {
        let contacts = fingers::contacts(&ask.fingers_m, "fingers_m", judged)?;
        cost::of_drives(&source.surface, judged, ask.window_s, ask.judge_hz, &contacts, 1)
    };
    if let Ok(cost) = estimate() {
        cost::announce(cost, LESS, progress);
    }
}

/// What would cost less than a drive that takes long.
const LESS: &str = "a lower top of the band, a coarser `accuracy` or a lower `judge_hz`";

/// Adds notes to a report on the library that its responses are from, and on its points that replace
/// requested ones.
fn tell_of_library(report: &mut Report, (told, notes): (String, Vec<Note>), nearby: Vec<Note>) {
    report.notes.extend(notes.into_iter().chain(nearby));
    report.judged_on.get_or_insert(told);
}

/// The window in s: the requested one, or the one recommended for the surface and its responses, then with a note that says why.
fn window(
    ask: &Ask,
    (surface, responses): (&Surface, &Responses),
    solved: &Solved,
    progress: &mut dyn Progress,
) -> Result<(f64, Option<Note>), TaskError> {
    let asked = ask.window_s;
    if asked.is_none() {
        go_on(progress)?;
        progress.stage("window");
    }
    let chosen = asked.is_none().then(|| solved.window(surface, responses));
    let window = asked.or(chosen.as_ref().map(|chosen| chosen.seconds)).unwrap_or_default();
    carries(responses.conditions(), window, "window_s")?;
    Ok((window, chosen.map(|chosen| Note { topic: "window", text: chosen.text() })))
}

/// Names of the fields that need a model, and whether the request sets them.
fn needing_modes(ask: &Ask) -> [(&'static str, bool); 7] {
    let on_surface = ask.on.is_some();
    [
        ("finger_aware", ask.finger_aware),
        ("bear_tension", ask.bear_tension.is_some()),
        ("bear_fingers_m", !ask.bear_fingers_m.is_empty()),
        ("judge_hz without on", ask.judge_hz.is_some() && !on_surface),
        ("fingers_m without on", !ask.fingers_m.is_empty() && !on_surface),
        ("method robust", ask.method == Method::Robust),
        ("method felt", ask.method == Method::Felt),
    ]
}

/// Options of the method for a window (s), with the limits of a surface.
pub(super) fn settings(ask: &Ask, surface: &Surface, window: f64) -> Result<Options, TaskError> {
    let loss = match (ask.losses, &surface.sheet.decay) {
        (Losses::None, _) => LossCorrection::None,
        (Losses::PerMode, _) => LossCorrection::PerMode,
        (Losses::Uniform, Decay::Time(tau)) => LossCorrection::Uniform(*tau),
        (Losses::Uniform, _) => {
            return Err(TaskError::ask(
                "losses uniform",
                "a surface with one decay time",
                "one that varies with frequency (nearest: `losses` per-mode)",
            ));
        }
    };
    let usual = Options::default();
    Ok(Options {
        method: ask.method,
        strength: ask.strength,
        push: ask.push,
        spread: ask.spread,
        rest: ask.rest,
        worst: ask.worst.unwrap_or(usual.worst),
        economy: ask.economy.unwrap_or(usual.economy),
        window,
        limit: surface.emission.limit,
        rms_limit: surface.emission.rms_limit,
        total_rms: ask.total_rms,
        loss,
        duration: ask.duration_s.map(|length| above_zero(length, "duration_s", "s")).transpose()?,
        ..usual
    })
}

/// The surface under fingers for which a drive is computed, and other states of it that the drive must tolerate.
fn aware(ask: &Ask, surface: &Surface) -> Result<Aware, TaskError> {
    let resting = fingers::contacts(&ask.fingers_m, "fingers_m", surface)?;
    let known = if ask.finger_aware { resting.as_slice() } else { &[] };
    let more = fingers::contacts(&ask.bear_fingers_m, "bear_fingers_m", surface)?;
    Ok(Aware::of(surface, known, ask.bear_tension, &more)?)
}
