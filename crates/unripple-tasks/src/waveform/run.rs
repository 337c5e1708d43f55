//! Computes a drive by which targets follow waveforms, and evaluates it.

use super::{Ask, Report, sound};
use crate::figures::Columns;
use crate::judge::reaches;
use crate::numbers::above_zero;
use crate::played::{Common, Made, Played, judge, keep};
use crate::{Progress, Source, TaskError, folder, point, source};
use unripple::act::Followed;
use unripple::core::{Responses, Surface};
use unripple::field::{Aim, Field, Wanted};
use unripple::focus::{PlayOptions, Target, Waveform, play};

/// Multiples of the top of the band up to which modes are used: 2 to plan waveforms, and by default 3 to
/// evaluate them, or 2 where 3 is out of reach. At low frequencies, modes far above add to the sheet's
/// flexibility.
const BANDS: [&[f64]; 2] = [&[2.0], &[3.0, 2.0]];

/// Computes a drive by which targets follow waveforms while other places are still, evaluates it, and
/// writes it to a folder if the request names one.
///
/// # Errors
/// [`TaskError::Ask`] without a waveform, and of numbers that make no sense; those of reading and writing files; those of the method;
/// [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    kept(ask, |progress| source::open(&ask.surface, progress), progress)
}

/// Does what [`run()`] does, but on the surface in `source` instead of the one that the request names; the
/// record in the output folder contains the request.
///
/// # Errors
/// Those of [`run()`], but for those of reading the surface.
pub fn run_on(ask: &Ask, source: Source, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    kept(ask, |_| Ok(source), progress)
}

/// Computes and evaluates a drive on the surface that `open` returns, and writes it to a folder if the
/// request names one.
fn kept(
    ask: &Ask,
    open: impl FnOnce(&mut dyn Progress) -> Result<Source, TaskError>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    something(ask)?;
    let drawn = (!ask.no_figures).then_some(Columns::of(ask.columns)?);
    let out = folder::begin(ask.output.as_deref(), ask)?;
    keep(make_on(ask, open(progress)?, progress)?, out, drawn, progress)
}

/// Computes and evaluates a drive as [`run()`] does, but returns all data and writes no folder.
///
/// # Errors
/// Those of [`run()`], except the errors of writing files.
pub fn make(ask: &Ask, progress: &mut dyn Progress) -> Result<Made, TaskError> {
    something(ask)?;
    make_on(ask, source::open(&ask.surface, progress)?, progress)
}

/// Computes and evaluates a drive as [`make()`] does, but for the surface in `source` instead of the one
/// that the request names. Waveforms need modes above the band, so responses of the band that were computed
/// earlier are used only where modes above it are out of reach.
///
/// # Errors
/// Those of [`make()`], except the errors of reading the surface.
pub fn make_on(ask: &Ask, source: Source, progress: &mut dyn Progress) -> Result<Made, TaskError> {
    something(ask)?;
    let common =
        Common { on: ask.on.as_ref(), judge_hz: ask.judge_hz, needs: "waveforms and path", bands: BANDS };
    let plan = |surface: &Surface| planned(ask, surface);
    judge(common, source, progress, plan, |waves, surface, models| followed(ask, &waves, surface, models))
}

/// Checks a request and its surface before any mode is computed, and returns an error for values that make
/// no sense.
///
/// # Errors
/// Those of [`run()`] that need neither modes nor a drive.
pub fn check(ask: &Ask, surface: &Surface) -> Result<(), TaskError> {
    something(ask)?;
    Columns::of(ask.columns)?;
    let plant = ask.on.as_ref().map(|on| on.load()).transpose()?;
    reaches(plant.as_ref().unwrap_or(surface), ask.judge_hz)?;
    planned(ask, surface).map(drop)
}

/// Returns an error if the request has no waveform.
fn something(ask: &Ask) -> Result<(), TaskError> {
    match ask.waveforms.is_empty() {
        true => Err(TaskError::ask("waveforms", "a waveform at a place", "none")),
        false => Ok(()),
    }
}

/// The waveforms at the surface's sample rate, after a check that their targets and the silent places lie
/// on the surface.
fn planned(ask: &Ask, surface: &Surface) -> Result<Vec<Waveform>, TaskError> {
    ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()?;
    let waves = ask.waveforms.iter().map(|waveform| sound::waveform(waveform, surface.emission.rate));
    let waves = waves.collect::<Result<Vec<_>, TaskError>>()?;
    let places = waves.iter().map(|wave| Target::of(wave.points.clone()));
    let places: Vec<_> = places.chain(ask.silent_m.iter().map(|place| Target::at(point(place)))).collect();
    Target::check(&places, &surface.outline).map_err(TaskError::input)?;
    Ok(waves)
}

fn followed(
    ask: &Ask,
    waves: &[Waveform],
    surface: &Surface,
    [model, judging]: [&Responses; 2],
) -> Result<Played, TaskError> {
    let emission = &surface.emission;
    let silent: Vec<_> = ask.silent_m.iter().map(point).collect();
    let window = ask.window_s.map(|window| above_zero(window, "window_s", "s")).transpose()?;
    let defaults = PlayOptions::default();
    let settings = PlayOptions {
        lead: window.map_or(defaults.lead, |window| [window; 2]),
        limit: emission.limit,
        rms_limit: emission.rms_limit,
        ..defaults
    };
    let played = play(model, waves, &silent, &settings).map_err(TaskError::input)?;
    let drive = played.drive.as_emitted();
    let rate = drive.rate();
    let targets = played.points.iter().zip(&played.prescribed);
    let wanted: Vec<Wanted> =
        targets.map(|(points, asked)| Wanted { points: points.clone(), samples: asked.clone() }).collect();
    let field = Field::new(judging, &drive, 1.0).map_err(TaskError::input)?;
    let until = 2.0 * drive.duration();
    let (figures, silent) =
        field.followed(&wanted, &silent, until, |t| &t.displacement).map_err(TaskError::input)?;
    drop(field);
    let largest = |asked: &[f64]| {
        let by_size = asked.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        by_size.map_or((0, 0.0), |(i, x)| (i, x.abs()))
    };
    let aims =
        wanted.iter().map(|w| Aim { points: w.points.clone(), instant: largest(&w.samples).0 as f64 / rate });
    let aims = aims.collect();
    let told = figures.into_iter().enumerate().map(|(i, figures)| Followed {
        figures,
        start_s: played.starts[i] as f64 / rate,
        asked_peak_m: largest(&wanted[i].samples).1,
        lost: played.lost[i],
    });
    let waveforms = told.collect();
    let after = settings.lead[1] / 2.0;
    Ok(Played { drive, aims, after, method: "waveforms", waveforms, silent, stroke: None })
}
