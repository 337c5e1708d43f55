//! Fits the model to a library, and computes its responses anywhere.

use super::measurements::Measurements;
use super::{Ask, Report, fill, probed::Probed, report};
use crate::numbers::accuracy;
use crate::{Progress, Record, TaskError, go_on, grid, source};
use std::path::Path;
use unripple::core::clock::Instant;
use unripple::core::{Point, Surface};
use unripple_calibrate::{FitOptions, Fitted, Verdict};
use unripple_store::{Library, StoreError};

/// The note on a fit of a surface with resonators: its basis is the sheet with its actuators.
const WITHOUT_RESONATORS: &str = "the fitted model has no resonators: what those of the surface file do to the responses is taken for \
                                  something else";

/// Largest number of half waves of a profile, and of stray loads: beyond it, a fit takes hours.
pub(crate) const MOST: usize = 8;

/// Modes are computed up to this frequency, in Hz, but no less than 1.4 and no more than 2.8 times the top of the band: above it, the sheet
/// reacts to a mass as an endless sheet, which holds for waves much shorter than the distance to the edge.
const KNOWN: f64 = 4200.0;

/// Fits the model to the responses between a library's actuators, and writes a library of the fitted
/// model's responses if the request names an output.
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; [`TaskError::Input`] of a library without what is needed; those of the fit and of
/// files; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let name = ask.library.display().to_string();
    if !Library::is_at(&ask.library) {
        return Err(TaskError::Input(format!(
            "{name}: expected a library that `calibrate` made, found none there"
        )));
    }
    // What was read is told as it was read: others may add to the library while the model is fitted.
    let record = ask.output.as_ref().map(|_| Record::of(ask)).transpose()?;
    let library = Library::open(&ask.library)?;
    let warned = source::warn(&library, progress);
    let mut surface = source::described(&library)?;
    if let Some(asked) = ask.accuracy {
        surface.accuracy = Some(accuracy(asked)?);
    }
    for (field, value) in [("strays", ask.strays), ("profile", ask.profile)] {
        if value > MOST {
            return Err(TaskError::ask(field, format!("at most {MOST}"), value));
        }
    }
    let wanted = wanted(ask, &surface)?;
    room(ask)?;
    let start = Instant::now();
    let (measurements, fitted) = model(&library, &surface, [ask.strays, ask.profile], progress)?;
    let probed = Probed::of(&fitted, &surface, &measurements)?;
    let fitted = fitted.scaled(probed.gain);
    let seconds = start.elapsed().as_secs_f64();
    let mut report = Report::of(&name, &surface, &fitted, seconds);
    report.left_out.clone_from(&probed.left_out);
    report.doubts.clone_from(&probed.doubts);
    report.notes = warned.into_iter().map(|note| note.text).chain(probed.notes.clone()).collect();
    if surface.sheet.uneven.resonates() {
        report.notes.push(WITHOUT_RESONATORS.into());
    }
    let why = match &fitted.verdict {
        Verdict::Good => None,
        Verdict::Doubtful { why, .. } => Some(why.clone()),
    };
    let wanted_in = ask.output.as_ref().filter(|_| why.is_none() || ask.even_if_doubtful);
    if let Some((folder, record)) = wanted_in.zip(record) {
        go_on(progress)?;
        fill::fill((&record, folder), &library, &surface, &fitted, &probed, &wanted, progress)?;
        report.written =
            Some(report::Written { library: folder.display().to_string(), points: wanted.len() });
    }
    report.failure = why.map(|why| failure(ask, &why));
    Ok(report)
}

/// Reads the responses between a library's actuators and fits the model to them, with at most `strays`
/// stray masses, and with at most `profile` half waves in the variation of tension over the sheet.
///
/// # Errors
/// [`TaskError::Input`] of a library without sensors at its actuators; those of the fit; [`TaskError::Cancelled`].
pub(crate) fn model(
    library: &Library,
    surface: &Surface,
    [strays, profile]: [usize; 2],
    progress: &mut dyn Progress,
) -> Result<(Measurements, Fitted), TaskError> {
    let measurements = Measurements::of(library, surface, progress)?;
    progress.tell(&format!(
        "fitting {} responses, which takes minutes in a band of some kHz",
        measurements.count()
    ));
    go_on(progress)?;
    progress.stage("fit");
    let plan = FitOptions {
        band: Some(measurements.band),
        profile,
        strays,
        reach: reach(measurements.band[1]),
        ..FitOptions::default()
    };
    let fitted = unripple_calibrate::fit(surface, &measurements.measured, &plan)?;
    go_on(progress)?;
    Ok((measurements, fitted))
}

/// Highest frequency of the modes that are computed for a fit, as a multiple of the top (Hz) of its band.
pub(crate) fn reach(top: f64) -> f64 {
    (KNOWN / top).clamp(1.4, 2.8)
}

/// Why a doubtful fit counts as failed, and whether anything was written.
fn failure(ask: &Ask, why: &str) -> String {
    match &ask.output {
        Some(folder) if !ask.even_if_doubtful => format!(
            "the model is doubtful: {why}; nothing was written to {} (`even_if_doubtful` writes it all the same)",
            folder.display()
        ),
        _ => format!("the model is doubtful: {why}"),
    }
}

/// Returns an error, before minutes of work, if the new library cannot be at the requested place.
fn room(ask: &Ask) -> Result<(), TaskError> {
    let Some(folder) = &ask.output else { return Ok(()) };
    let real = |path: &Path| std::fs::canonicalize(path).ok();
    if real(folder).is_some_and(|folder| Some(folder) == real(&ask.library)) {
        return Err(StoreError::Reads { path: folder.clone(), read: ask.library.clone() }.into());
    }
    Ok(Library::may_be_at(folder)?)
}

/// Points at which responses of the fitted model are requested.
fn wanted(ask: &Ask, surface: &Surface) -> Result<Vec<Point>, TaskError> {
    let points = grid::places(&surface.outline, ask.pitch_m, &ask.points_m)?;
    if ask.output.is_some() && points.is_empty() {
        return Err(TaskError::ask(
            "output",
            "`pitch_m` or `points_m` as well, the points of the new library",
            "neither",
        ));
    }
    Ok(points)
}
