//! Evaluates the field of a drive: the motion of the surface.

use super::{Ask, DriveAsk, Made, Report, write};
use crate::figures::{self, Columns, MOST_FRAMES, When};
use crate::judge::{self, CELLS, Models};
use crate::numbers::above_zero;
use crate::{Progress, Source, TaskError, fingers, folder, go_on, point, source};
use unripple::act;
use unripple::core::{Drive, Point, Surface};
use unripple::field::{Aim, Field, FieldError, fits};
use unripple_store::read_wav;

/// Evaluates the motion of a surface under a drive, and writes the results to a folder if the request names
/// one.
///
/// # Errors
/// [`TaskError::Ask`] of numbers that make no sense; those of reading and writing files; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    kept(ask, |progress| open(ask, progress), progress)
}

/// Does what [`run()`] does, but on the surface or responses in `source` instead of those that the request
/// names; the record in the output folder contains the request.
///
/// # Errors
/// Those of [`run()`], but for those of reading them.
pub fn run_on(ask: &Ask, source: Source, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let given = |_: &mut dyn Progress| {
        numbers(ask)?;
        driven(ask, source)
    };
    kept(ask, given, progress)
}

/// Evaluates the drive on the surface or responses that `open` returns, and writes the results to a folder
/// if the request names one.
fn kept(
    ask: &Ask,
    open: impl FnOnce(&mut dyn Progress) -> Result<(Source, Drive), TaskError>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    Columns::of(ask.columns)?;
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let (source, drive) = open(progress)?;
    let (mut made, movie) = measured(ask, source, drive, !ask.no_figures && out.is_some(), progress)?;
    if let Some(out) = out {
        write::write(ask, out, &mut made, movie, progress)?;
    }
    Ok(made.report)
}

/// Evaluates the motion of a surface under a drive as [`run()`] does, but returns all data and writes no
/// folder.
///
/// # Errors
/// Those of [`run()`], except the errors of writing files.
pub fn make(ask: &Ask, progress: &mut dyn Progress) -> Result<Made, TaskError> {
    let (source, drive) = open(ask, progress)?;
    Ok(measured(ask, source, drive, false, progress)?.0)
}

/// Does what [`make()`] does, but for the surface or responses in `source` and for `drive`, instead of
/// those that the request names.
///
/// # Errors
/// Those of [`make()`], except the errors of reading surface and drive.
pub fn make_on(
    ask: &Ask,
    source: Source,
    drive: Drive,
    progress: &mut dyn Progress,
) -> Result<Made, TaskError> {
    numbers(ask)?;
    allow(ask, &source)?;
    before_modes(ask, &source, &drive)?;
    Ok(measured(ask, source, drive, false, progress)?.0)
}

/// The surface or responses and the drive that a request names.
fn open(ask: &Ask, progress: &mut dyn Progress) -> Result<(Source, Drive), TaskError> {
    numbers(ask)?;
    driven(ask, source::open(&ask.surface, progress)?)
}

/// A surface or responses, with the drive that a request names.
fn driven(ask: &Ask, source: Source) -> Result<(Source, Drive), TaskError> {
    allow(ask, &source)?;
    let drive = drive(&ask.drive, &source.surface)?;
    before_modes(ask, &source, &drive)?;
    Ok((source, drive))
}

/// Returns an error for fields of the request that need a model if the source is a library of responses.
fn allow(ask: &Ask, source: &Source) -> Result<(), TaskError> {
    source.allows(&[("fingers_m", !ask.fingers_m.is_empty()), ("judge_hz", ask.judge_hz.is_some())])
}

/// Evaluates the field and returns all data, with the animation if `animated`.
fn measured(
    ask: &Ask,
    source: Source,
    drive: Drive,
    animated: bool,
    progress: &mut dyn Progress,
) -> Result<(Made, Option<Vec<u8>>), TaskError> {
    let contacts = fingers::contacts(&ask.fingers_m, "fingers_m", &source.surface)?;
    let places: Vec<Point> = ask.points_m.iter().map(point).collect();
    let unscaled = source.without_scale().is_some();
    go_on(progress)?;
    progress.stage("responses");
    let (surface, (models, judging), stored) = match source.stored {
        Some(_) => {
            let (surface, free, stored) = source.respond(&places, ask.between)?;
            (surface, (Models { free, under: None }, None), stored)
        }
        None => {
            let (models, judging) = judge::models(&source.surface, ask.judge_hz, &contacts, &source.solved)?;
            (source.surface, (models, Some(judging)), None)
        }
    };
    let responses = models.under.as_ref().unwrap_or(&models.free);
    let period = ask.period_s;
    go_on(progress)?;
    progress.stage("field");
    let field = Field::new(responses, &drive, CELLS).map_err(TaskError::input)?;
    if animated {
        figures::check_animation(&field, ask.frames, ask.movie_s)?;
    }
    let aims = aims(ask, places, &field, &drive, period)?;
    let last = aims.iter().map(|aim| aim.instant).fold(0.0, f64::max);
    let until = if period.is_some() { drive.duration() - 1.0 / drive.rate() } else { 2.0 * last };
    let judged = judge::judge(&surface, &field, &aims, period, until, progress)?;
    let movie = match animated {
        true => write::movie(ask, &surface, &field, &aims, &judged, progress)?,
        false => None,
    };
    drop(field);

    let mut report = Report::new("field", &surface, &drive, &judged);
    report.period_s = period;
    if let Some((told, notes)) = stored {
        report.notes.extend(notes);
        report.judged_on = Some(told);
    }
    judging.iter().for_each(|judging| judging.tell(&surface, &mut report));
    report.sound = Some(judge::heard(&surface, responses, ask.listen_m, &drive, period)?);
    report.fingers = act::felt(&contacts, &surface, [responses, &models.free], &drive, until)?;
    if unscaled {
        report = report.without_scale();
    }
    let responses = models.under.unwrap_or(models.free);
    let when = if ask.instants_s.is_empty() { When::Fastest } else { When::Requested };
    Ok((Made { report, drive, judged, aims, surface, responses, scaled: !unscaled, when }, movie))
}

/// Checks a request, its surface and its drive before any mode is computed, and returns an error for values
/// that make no sense.
///
/// # Errors
/// Those of [`run()`] that need neither modes nor a field.
pub fn check(ask: &Ask, surface: &Surface, drive: &Drive) -> Result<(), TaskError> {
    numbers(ask)?;
    let names: Vec<&str> = surface.actuators.iter().map(|actuator| actuator.name.as_str()).collect();
    fits(&names, surface.emission.rate, drive).map_err(TaskError::input)?;
    judge::reaches(surface, ask.judge_hz)?;
    let outline = &surface.outline;
    if let Some(at) = ask.points_m.iter().map(point).find(|at| !outline.contains(*at)) {
        return Err(TaskError::input(FieldError::Outside { at, nearest: outline.nearest(at) }));
    }
    fingers::contacts(&ask.fingers_m, "fingers_m", surface).map(drop)
}

/// Checks the request as [`check`] does if the source is a surface; for a library nothing is left to check
/// before its responses are used.
fn before_modes(ask: &Ask, source: &Source, drive: &Drive) -> Result<(), TaskError> {
    source.stored.as_ref().map_or_else(|| check(ask, &source.surface, drive), |_| Ok(()))
}

/// Returns an error for numbers that make no sense on any surface.
fn numbers(ask: &Ask) -> Result<(), TaskError> {
    judge::listening(ask.listen_m)?;
    Columns::of(ask.columns)?;
    ask.period_s.map(|period| above_zero(period, "period_s", "s")).transpose()?;
    // Without a place there is one, where the field is strongest.
    let (instants, places) = (ask.instants_s.len(), ask.points_m.len().max(1));
    if instants > 1 && instants != places {
        return Err(TaskError::ask("instants_s", format!("one, or one per `points_m` ({places})"), instants));
    }
    animated(ask.frames, ask.movie_s)
}

/// Returns an error if the number of frames or the span (start and end, in s) of an animation makes no
/// sense.
pub(super) fn animated(frames: usize, span: Option<[f64; 2]>) -> Result<(), TaskError> {
    if let Some([from, to]) = span.filter(|[from, to]| !(*from >= 0.0 && to > from && to.is_finite())) {
        return Err(TaskError::ask(
            "movie_s",
            "a start from 0 and an end after it",
            format!("{from} to {to}"),
        ));
    }
    if frames > MOST_FRAMES {
        return Err(TaskError::ask("frames", format!("at most {MOST_FRAMES}"), frames));
    }
    Ok(())
}

/// The drive of a request, for the actuators of a surface.
pub(crate) fn drive(ask: &DriveAsk, surface: &Surface) -> Result<Drive, TaskError> {
    let names: Vec<String> = surface.actuators.iter().map(|a| a.name.clone()).collect();
    match ask {
        DriveAsk::File(file) => Ok(read_wav(file)?.into_drive(&names, &file.display().to_string())?),
        DriveAsk::Samples { channels, rate_hz } => {
            Drive::new(*rate_hz, names, channels.clone()).map_err(TaskError::input)
        }
    }
}

/// Points and instants of the evaluation: as requested, or by default the point of the largest velocity and
/// each point's instant of largest velocity.
fn aims(
    ask: &Ask,
    mut points: Vec<Point>,
    field: &Field,
    drive: &Drive,
    period: Option<f64>,
) -> Result<Vec<Aim>, TaskError> {
    if points.is_empty() {
        points.push(strongest(field, drive, period)?);
    }
    let instants = match (ask.instants_s.as_slice(), points.len()) {
        ([], _) => own_peaks(field, drive, period, &points)?,
        ([one], n) => vec![*one; n],
        (many, _) => many.to_vec(),
    };
    Ok(points.into_iter().zip(instants).map(|(point, instant)| Aim::at(point, instant)).collect())
}

/// The point with the largest peak velocity while the drive lasts.
fn strongest(field: &Field, drive: &Drive, period: Option<f64>) -> Result<Point, TaskError> {
    let last =
        Aim::at(field.points().first().copied().unwrap_or_default(), drive.duration() - 1.0 / drive.rate());
    let maps = field.measure(&[last], period).map_err(TaskError::input)?.maps;
    let peaks = maps.peak_velocity.iter().zip(&maps.points);
    let best = peaks.max_by(|a, b| a.0.total_cmp(b.0)).map(|(_, point)| *point);
    best.ok_or_else(|| TaskError::Input("the surface has no point to measure at".into()))
}

/// The instant (s) at which the velocity of each point is largest while the drive lasts, or in its last
/// full period.
fn own_peaks(
    field: &Field,
    drive: &Drive,
    period: Option<f64>,
    points: &[Point],
) -> Result<Vec<f64>, TaskError> {
    let end = drive.duration() - 1.0 / drive.rate();
    let first =
        period.map_or(0, |period| ((drive.duration() - period).max(0.0) * drive.rate()).round() as usize);
    let traces = field.traces(points, end).map_err(TaskError::input)?;
    let largest = |values: &[f64]| {
        let tail = values.iter().enumerate().skip(first);
        tail.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(0, |(i, _)| i)
    };
    Ok(traces.iter().map(|trace| largest(&trace.velocity) as f64 / drive.rate()).collect())
}
