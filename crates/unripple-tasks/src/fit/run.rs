//! The model fitted to a library, and its responses anywhere.

use super::heard::Heard;
use super::{Ask, Report, fill, probed::Probed, report};
use crate::{Progress, TaskError, go_on, grid, source};
use std::path::Path;
use std::time::Instant;
use unripple::core::{Point, Surface};
use unripple_calibrate::{FitOptions, Fitted, Verdict};
use unripple_store::{Library, StoreError};

/// Most half waves of a profile, and most stray loads: beyond, a fit takes hours.
const MOST: usize = 8;

/// Modes are known up to here, in Hz, but no less than 1.4 and no more than 2.8 times the band's top: what a mass feels of those above is
/// that of an endless sheet, which is good for waves much shorter than the way to the edge.
const KNOWN: f64 = 4200.0;

/// Fits the model to the responses of a library's actuators at each other, and may write a library of its responses.
///
/// # Errors
/// [`TaskError::Ask`] of what makes no sense; [`TaskError::Input`] of a library without what is needed; those of the fit and of files;
/// [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let name = ask.library.display().to_string();
    if !Library::is_at(&ask.library) {
        return Err(TaskError::Input(format!(
            "{name}: expected a library that `calibrate` made, found none there"
        )));
    }
    let library = Library::open(&ask.library)?;
    let warned = source::warn(&library, progress);
    let surface = source::described(&library)?;
    for (field, value) in [("strays", ask.strays), ("profile", ask.profile)] {
        if value > MOST {
            return Err(TaskError::ask(field, format!("at most {MOST}"), value));
        }
    }
    let wanted = wanted(ask, &surface)?;
    room(ask)?;
    let start = Instant::now();
    let (heard, fitted) = model(&library, &surface, [ask.strays, ask.profile], progress)?;
    let probed = Probed::of(&fitted, &surface, &heard)?;
    let fitted = fitted.scaled(probed.gain);
    let seconds = start.elapsed().as_secs_f64();
    let mut report = Report::of(&name, &surface, &fitted, seconds);
    report.left_out.clone_from(&probed.left_out);
    report.doubts.clone_from(&probed.doubts);
    report.notes = warned.into_iter().map(|note| note.text).chain(probed.notes.clone()).collect();
    let why = match &fitted.verdict {
        Verdict::Good => None,
        Verdict::Doubtful { why, .. } => Some(why.clone()),
    };
    if let Some(folder) = ask.output.as_ref().filter(|_| why.is_none() || ask.even_if_doubtful) {
        go_on(progress)?;
        fill::fill(folder, &library, &surface, &fitted, &probed, &wanted, progress)?;
        report.written =
            Some(report::Written { library: folder.display().to_string(), points: wanted.len() });
    }
    report.failure = why.map(|why| failure(ask, &why));
    Ok(report)
}

/// What a library's actuators heard of each other, and the model fitted to it, with at most so many stray masses, and half waves of the
/// tension's profile.
///
/// # Errors
/// [`TaskError::Input`] of a library whose actuators do not listen; those of the fit; [`TaskError::Cancelled`].
pub(crate) fn model(
    library: &Library,
    surface: &Surface,
    [strays, profile]: [usize; 2],
    progress: &mut dyn Progress,
) -> Result<(Heard, Fitted), TaskError> {
    let heard = Heard::of(library, surface, progress)?;
    progress.tell(&format!("fitting {} responses; minutes in a band of some kHz", heard.count()));
    go_on(progress)?;
    progress.stage("fit");
    let plan = FitOptions {
        band: Some(heard.band),
        profile,
        strays,
        reach: (KNOWN / heard.band[1]).clamp(1.4, 2.8),
        ..FitOptions::default()
    };
    let fitted = unripple_calibrate::fit(surface, &heard.measured, &plan)?;
    go_on(progress)?;
    Ok((heard, fitted))
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

/// Refuses, before minutes of work, a place where the new library cannot be.
fn room(ask: &Ask) -> Result<(), TaskError> {
    let Some(folder) = &ask.output else { return Ok(()) };
    let real = |path: &Path| std::fs::canonicalize(path).ok();
    if real(folder).is_some_and(|folder| Some(folder) == real(&ask.library)) {
        return Err(StoreError::Reads { path: folder.clone(), read: ask.library.clone() }.into());
    }
    Ok(Library::may_be_at(folder)?)
}

/// Where responses of the fitted model are wanted.
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
