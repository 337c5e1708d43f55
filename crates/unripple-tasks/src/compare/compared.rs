//! Results of all methods on one of the surfaces that are compared.

use super::Ask;
use super::failed::{Failed, survived};
use super::front::{self, Front};
use super::ground::Ground;
use super::row::{self, Row};
use crate::source::{Source, Told};
use crate::target::targets;
use crate::window::{carries, of_window};
use crate::{Progress, Solved, TaskError, cost, go_on, judge};
use serde::Serialize;
use unripple::act::{Level, Note, Readouts, chosen_window};
use unripple::core::{Responses, Surface};
use unripple::focus::{Method, Options};
use unripple_calibrate::Interpolation;

/// Results of all methods on one surface, one row each, and the tradeoff curves of their parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// Name of the surface in the comparison.
    pub label: String,
    /// Name of the surface in its file.
    pub surface: String,
    /// Window T, in s.
    pub window_s: f64,
    /// Reason for the default window; absent if the request sets the window.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_why: Option<String>,
    /// Number of modes that drives were computed from: those in the surface's band.
    pub modes: usize,
    /// Highest frequency of the modes that drives were evaluated on, in Hz; on a library the top of its band.
    pub judged_to_hz: f64,
    /// Reason why the modes for evaluation do not reach the default frequency or accuracy; absent if they
    /// do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judged_to_why: Option<String>,
    /// Points of the library that drives were evaluated on; absent on a surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judged_on: Option<String>,
    /// Notes on the library; absent without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<Note>,
    /// Results of every method that did not fail, time reversal first.
    pub methods: Vec<Row>,
    /// Methods that failed, each with the reason.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<Failed>,
    /// Tradeoff curves of the methods that have a parameter; empty on several surfaces, and if `no_tradeoffs` was requested.
    pub fronts: Vec<Front>,
    /// Results of time reversal, followed by those of the method `felt` for increasing weights of the
    /// drive's energy; empty on several surfaces, and if `no_tradeoffs` was requested.
    pub felt: Vec<Row>,
    /// Sentence on the default window; `None` if the request sets the window.
    #[serde(skip)]
    pub(super) window_text: Option<String>,
}

/// Computes and evaluates the drive of every method on a surface, and on a single surface also the tradeoff
/// curves of the methods' parameters. `of` begins the names of stages with that of the surface, if there
/// are several.
pub(super) fn on(
    ask: &Ask,
    source: Source,
    level: Level,
    (label, of): (String, &str),
    progress: &mut dyn Progress,
) -> Result<Compared, TaskError> {
    let solved = Solved::default();
    let source = source.with(&solved);
    let unscaled = source.without_scale().is_some();
    if source.stored.is_none() {
        announce(ask, &source.surface, progress);
    }
    progress.stage(&format!("{of}responses"));
    let targets = targets(&ask.points, &ask.shapes, source.shortest_wavelength())?;
    let places: Vec<_> = targets.iter().flat_map(|target| target.points.iter().copied()).collect();
    let (surface, known, stored) = source.respond(&places, Interpolation::default())?;
    let surface = &surface;
    go_on(progress)?;
    progress.stage(&format!("{of}{}", judge::RESPONSES));
    let (plant, judged) = evaluated(ask, surface, &known, stored, &solved)?;
    let asked = ask.window_s;
    go_on(progress)?;
    progress.stage(&format!("{of}window"));
    let chosen = asked.is_none().then(|| chosen_window(surface, &known));
    let window = asked.or(chosen.as_ref().map(|chosen| chosen.seconds)).unwrap_or_default();
    carries(known.conditions(), window, "window_s")?;
    let ground = Ground {
        surface,
        known: &known,
        plant: &plant,
        on: &Readouts::of(&plant).heard_at(judge::listening(ask.listen_m)?),
        targets: &targets,
        options: &settings(surface, window),
        level,
    };
    let Results { methods, failed, fronts, felt } = results(&ground, ask, unscaled, progress)?;
    Ok(Compared {
        label,
        surface: surface.name.clone(),
        window_s: window,
        window_why: chosen.as_ref().map(|chosen| chosen.why.clone()),
        modes: modes(&known),
        judged_to_hz: judged.to_hz,
        judged_to_why: judged.why,
        judged_on: judged.on,
        notes: judged.notes,
        methods,
        failed,
        fronts,
        felt,
        window_text: chosen.map(|chosen| chosen.text()),
    })
}

/// Rows and tradeoff curves of all methods.
struct Results {
    methods: Vec<Row>,
    failed: Vec<Failed>,
    fronts: Vec<Front>,
    felt: Vec<Row>,
}

/// The rows of all methods and, on a single surface, their tradeoff curves; without absolute levels if the responses are `unscaled`.
fn results(
    ground: &Ground<'_>,
    ask: &Ask,
    unscaled: bool,
    progress: &mut dyn Progress,
) -> Result<Results, TaskError> {
    let (mut methods, mut failed) = rows(ground, ask, progress)?;
    let reversal = reversal(&methods)?;
    row::relate(&mut methods);
    let (fronts, mut felt) = match ask.no_tradeoffs || !ask.others.is_empty() {
        true => (Vec::new(), Vec::new()),
        false => front::both(ground, &methods, reversal, &mut failed, progress)?,
    };
    if unscaled {
        let ratios = |rows: Vec<Row>| rows.into_iter().map(Row::without_scale).collect();
        (methods, felt) = (ratios(methods), ratios(felt));
    }
    Ok(Results { methods, failed, fronts, felt })
}

/// What drives are evaluated on, in words.
struct JudgedOn {
    to_hz: f64,
    why: Option<String>,
    on: Option<String>,
    notes: Vec<Note>,
}

/// The responses that drives are evaluated on: modes beyond the band, or a library itself.
fn evaluated(
    ask: &Ask,
    surface: &Surface,
    known: &Responses,
    stored: Option<Told>,
    solved: &Solved,
) -> Result<(Responses, JudgedOn), TaskError> {
    if let Some((told, notes)) = stored {
        let judged = JudgedOn { to_hz: known.conditions().band[1], why: None, on: Some(told), notes };
        return Ok((known.clone(), judged));
    }
    let (judge::Models { free, .. }, judging) = judge::models(surface, ask.judge_hz, &[], solved)?;
    let judged = JudgedOn { to_hz: judging.hz, why: judging.why(), on: None, notes: Vec::new() };
    Ok((free, judged))
}

/// Number of drives that tradeoff curves are made of.
const ON_CURVES: usize = 30;

/// Tells what the comparison will cost.
fn announce(ask: &Ask, surface: &Surface, progress: &mut dyn Progress) {
    let curves = if ask.no_tradeoffs || !ask.others.is_empty() { 0 } else { ON_CURVES };
    let drives = ask.chosen().count() + curves;
    let less = match curves {
        0 => "a lower top of the band, a coarser `accuracy` or a lower `judge_hz`",
        _ => "`no_tradeoffs`, a lower top of the band, a coarser `accuracy` or a lower `judge_hz`",
    };
    // What cannot be estimated is refused where it is computed.
    if let Ok(cost) = cost::of_drives(surface, surface, ask.window_s, ask.judge_hz, &[], drives) {
        cost::announce(cost, less, progress);
    }
}

/// Options of all methods: the window (s) and the surface's limits.
fn settings(surface: &Surface, window: f64) -> Options {
    let (limit, rms_limit) = (surface.emission.limit, surface.emission.rms_limit);
    Options { window, limit, rms_limit, ..Options::default() }
}

/// The row of every method, time reversal first, and the methods that failed.
fn rows(
    ground: &Ground<'_>,
    ask: &Ask,
    progress: &mut dyn Progress,
) -> Result<(Vec<Row>, Vec<Failed>), TaskError> {
    let (mut rows, mut failed) = (Vec::new(), Vec::new());
    for method in ask.chosen() {
        go_on(progress)?;
        progress.stage(method.name());
        match row::judge(ground, method).map_err(|error| of_window(error, ask.window_s.is_some())) {
            // All others are held against it.
            Err(error) if method == Method::TimeReversal => return Err(error),
            judged => rows.extend(survived(judged, method, &mut failed)?),
        }
    }
    Ok((rows, failed))
}

/// The row of time reversal, to which tradeoff curves are related, before its values are divided by
/// themselves.
fn reversal(rows: &[Row]) -> Result<Row, TaskError> {
    let found = rows.iter().find(|row| row.method == Method::TimeReversal.name());
    found
        .cloned()
        .ok_or_else(|| TaskError::Work("time reversal: expected among the methods, found none".into()))
}

/// Number of modes of a surface's responses; 0 for sampled responses.
fn modes(responses: &Responses) -> usize {
    match responses {
        Responses::Modal(modal) => modal.poles.len(),
        Responses::Sampled(_) => 0,
    }
}
