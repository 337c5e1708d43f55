//! Computes a drive whose focus moves along a path, and evaluates it.

use super::{Ask, Report};
use crate::figures::Columns;
use crate::judge::reaches;
use crate::numbers::above_zero;
use crate::played::{Common, Made, Played, judge, keep};
use crate::window::{carries, conditions};
use crate::{Progress, Source, TaskError, folder, source};
use unripple::act::Stroked;
use unripple::core::{Drive, Point, Responses, Surface};
use unripple::field::{Aim, Field};
use unripple::focus::{FocusError, Pattern, PulseOptions, Stroke, Target, strike};

/// Multiples of the top of the band up to which modes are used: 1 to plan a stroke, whose pulses fill the
/// whole band, and by default 2 to evaluate it.
const BANDS: [&[f64]; 2] = [&[1.0], &[2.0]];

/// Number of places along a stroke that are evaluated at once, which bounds memory.
const AT_ONCE: usize = 256;

/// Number of places evaluated for each pulse of a stroke: one at each focus and one midway, where a gap
/// would show.
const BETWEEN: usize = 2;

/// Computes a drive whose focus moves along a path at constant level, evaluates it, and writes it to a
/// folder if the request names one.
///
/// # Errors
/// [`TaskError::Ask`] of numbers that make no sense; those of reading and writing files; those of the method; [`TaskError::Cancelled`].
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
    velocities(ask)?;
    let drawn = (!ask.no_figures).then_some(Columns::of(ask.columns)?);
    let out = folder::begin(ask.output.as_deref(), ask)?;
    keep(make_on(ask, open(progress)?, progress)?, out, drawn, progress)
}

/// Computes and evaluates a drive as [`run()`] does, but returns all data and writes no folder.
///
/// # Errors
/// Those of [`run()`], except the errors of writing files.
pub fn make(ask: &Ask, progress: &mut dyn Progress) -> Result<Made, TaskError> {
    velocities(ask)?;
    make_on(ask, source::open(&ask.surface, progress)?, progress)
}

/// Computes and evaluates a drive as [`make()`] does, but for the surface or responses in `source` instead
/// of those that the request names.
///
/// # Errors
/// Those of [`make()`], except the errors of reading the surface or responses.
pub fn make_on(ask: &Ask, source: Source, progress: &mut dyn Progress) -> Result<Made, TaskError> {
    velocities(ask)?;
    let common =
        Common { on: ask.on.as_ref(), judge_hz: ask.judge_hz, needs: "waveforms and path", bands: BANDS };
    let plan = |surface: &Surface| planned(ask, surface);
    judge(common, source, progress, plan, |stroke, surface, models| stroked(ask, surface, &stroke, models))
}

/// Checks a request and its surface before any mode is computed, and returns an error for values that make
/// no sense.
///
/// # Errors
/// Those of [`run()`] that need neither modes nor a drive.
pub fn check(ask: &Ask, surface: &Surface) -> Result<(), TaskError> {
    Columns::of(ask.columns)?;
    let plant = ask.on.as_ref().map(|on| on.load()).transpose()?;
    reaches(plant.as_ref().unwrap_or(surface), ask.judge_hz)?;
    planned(ask, surface).map(drop)
}

/// The stroke of a request, after a check that its pulses lie on the surface and that its speed suits the
/// waves.
fn planned(ask: &Ask, surface: &Surface) -> Result<Stroke, TaskError> {
    let [speed, level] = velocities(ask)?;
    let path = Pattern { filled: false, ..ask.path.pattern("path")? };
    let stroke = Stroke { level, ..Stroke::along(path, speed) };
    let conditions = conditions(surface);
    if let Some(window) = ask.window_s {
        carries(&conditions, above_zero(window, "window_s", "s")?, "window_s")?;
    }
    let pulses = stroke.pulses_in(&conditions).map_err(refused)?;
    let places: Vec<_> = pulses.into_iter().map(|pulse| Target::of(pulse.points)).collect();
    Target::check(&places, &surface.outline).map_err(TaskError::input)?;
    Ok(stroke)
}

/// Speed of the focus along the path, and requested velocity of the sheet at the focus, both in m/s.
fn velocities(ask: &Ask) -> Result<[f64; 2], TaskError> {
    Ok([above_zero(ask.speed_m_s, "speed_m_s", "m/s")?, above_zero(ask.level_m_s, "level_m_s", "m/s")?])
}

/// Converts an error about a stroke; an error about its speed names the field of the request that sets it.
fn refused(error: FocusError) -> TaskError {
    match &error {
        FocusError::Range(range) if range.what.starts_with("speed") => {
            TaskError::Input(format!("`speed_m_s`: {error}"))
        }
        _ => TaskError::input(error),
    }
}

fn stroked(
    ask: &Ask,
    surface: &Surface,
    stroke: &Stroke,
    [model, judging]: [&Responses; 2],
) -> Result<Played, TaskError> {
    let defaults = PulseOptions::default();
    let settings = PulseOptions {
        window: ask.window_s.map_or(Ok(defaults.window), |window| above_zero(window, "window_s", "s"))?,
        limit: surface.emission.limit,
        rms_limit: surface.emission.rms_limit,
        ..defaults
    };
    carries(model.conditions(), settings.window, "window_s")?;
    let pulses = stroke.pulses(model).map_err(refused)?;
    let struck = strike(model, &pulses, &settings).map_err(TaskError::input)?;
    let drive = struck.drive.as_emitted();
    let asked = stroke.level * struck.scale;
    let [level, peak] =
        evenness(stroke, &struck.instants, &drive, judging)?.map(|range| range.map(|v| decibels(v / asked)));
    let start = struck.instants[0] as f64 / drive.rate();
    let stroked = Stroked {
        pulses: pulses.len(),
        duration_s: stroke.duration(),
        start_s: start,
        asked_m_s: asked,
        level_range_db: level,
        peak_range_db: peak,
    };
    let middle = pulses.len() / 2;
    let instant = struck.instants[middle] as f64 / drive.rate();
    let aims = vec![Aim { points: struck.points[middle].clone(), instant }];
    Ok(Played {
        drive,
        aims,
        after: settings.window / 2.0,
        method: "stroke",
        waveforms: Vec::new(),
        silent: Vec::new(),
        stroke: Some(stroked),
    })
}

/// Least and greatest velocity along a path, in m/s: first at each place at the instant of the nearest
/// pulse, then as the largest velocity within half an interval between pulses around the time at which the
/// focus passes the place.
fn evenness(
    stroke: &Stroke,
    instants: &[usize],
    drive: &Drive,
    responses: &Responses,
) -> Result<[[f64; 2]; 2], TaskError> {
    let field = Field::new(responses, drive, 1.0).map_err(TaskError::input)?;
    let steps = BETWEEN * instants.len().saturating_sub(1).max(1);
    let (first, last) = (instants[0], instants[instants.len() - 1]);
    let sample = |i: usize| first + (last - first) * i / steps;
    let place = |i: usize| stroke.place((sample(i) - first) as f64 / drive.rate());
    let half = (last - first).div_ceil(2 * instants.len().saturating_sub(1).max(1));
    let mut found = [[f64::INFINITY, 0.0]; 2];
    for batch in (0..=steps).collect::<Vec<_>>().chunks(AT_ONCE) {
        let places: Vec<Point> = batch.iter().map(|i| place(*i)).collect();
        let until = drive.duration() - 1.0 / drive.rate();
        let traces = field.traces(&places, until).map_err(TaskError::input)?;
        for (i, trace) in batch.iter().zip(traces) {
            let v = |i: usize| trace.velocity[i].abs();
            let pulse = instants[(i + BETWEEN / 2).min(steps) / BETWEEN];
            let near = sample(*i).saturating_sub(half)..(sample(*i) + half + 1).min(trace.velocity.len());
            for ([least, most], level) in found.iter_mut().zip([v(pulse), near.map(v).fold(0.0, f64::max)]) {
                (*least, *most) = (least.min(level), most.max(level));
            }
        }
    }
    Ok(found)
}

fn decibels(ratio: f64) -> f64 {
    20.0 * ratio.max(1e-20).log10()
}
