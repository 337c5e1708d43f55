//! `unripple fit`: the model fitted to what a library's actuators heard of each other.

mod fill;
mod heard;
mod probed;
mod report;

use crate::args::FitOptions;
use crate::error::CliError;
use crate::{grid, input, output};
use probed::Probed;
use report::Report;
use std::path::Path;
use std::time::Instant;
use unripple::core::{Point, Surface};
use unripple_calibrate::Verdict;
use unripple_store::{Library, StoreError};

/// Most half waves of a profile, and most strays: beyond, a fit takes hours.
const MOST: usize = 8;

/// Modes are known up to here, in Hz, but no less than 1.4 and no more than 2.8 times the band's top: what a mass feels of those above is
/// that of an endless sheet, which is good for waves much shorter than the way to the edge.
const KNOWN: f64 = 4200.0;

pub fn run(options: &FitOptions, as_json: bool) -> Result<(), CliError> {
    if !Library::is_at(&options.library) {
        return Err(CliError::Input(format!(
            "{}: expected a library that `calibrate` made, found none there",
            options.library
        )));
    }
    let library = Library::open(&options.library)?;
    let warned = input::warn(&library);
    let Some(surface) = library.plan().surface.clone() else {
        return Err(CliError::Input(format!(
            "{}: expected a library that describes its surface, found one without",
            options.library
        )));
    };
    for (option, value) in [("--strays", options.strays), ("--profile", options.profile)] {
        if value > MOST {
            return Err(CliError::Input(format!("{option}: expected at most {MOST}, found {value}")));
        }
    }
    let wanted = wanted(options, &surface)?;
    room(options)?;
    let heard = heard::Heard::of(&library, &surface)?;
    eprintln!("fitting {} responses; minutes in a band of some kHz", heard.count());
    let start = Instant::now();
    let plan = unripple_calibrate::FitOptions {
        band: Some(heard.band),
        profile: options.profile,
        strays: options.strays,
        reach: (KNOWN / heard.band[1]).clamp(1.4, 2.8),
        ..unripple_calibrate::FitOptions::default()
    };
    let fitted = unripple_calibrate::fit(&surface, &heard.measured, &plan)?;
    let probed = Probed::of(&fitted, &surface, &heard)?;
    let fitted = fitted.scaled(probed.gain);
    let seconds = start.elapsed().as_secs_f64();
    let mut report = Report::of(&options.library, &surface, &fitted, seconds);
    report.left_out.clone_from(&probed.left_out);
    report.doubts.clone_from(&probed.doubts);
    report.notes = warned.into_iter().map(|note| note.text).chain(probed.notes.clone()).collect();
    let why = match &fitted.verdict {
        Verdict::Good => None,
        Verdict::Doubtful { why, .. } => Some(why.clone()),
    };
    if let Some(folder) = options.output.as_ref().filter(|_| why.is_none() || options.even_if_doubtful) {
        fill::fill(folder, &library, &surface, &fitted, &probed, &wanted)?;
        report.written =
            Some(report::Written { library: folder.display().to_string(), points: wanted.len() });
    }
    output::answer(as_json, &report, &report.text())?;
    match (why, &options.output) {
        (None, _) => Ok(()),
        (Some(why), Some(folder)) if !options.even_if_doubtful => Err(CliError::Work(format!(
            "the model is doubtful: {why}; nothing was written to {} (--even-if-doubtful writes it all the same)",
            folder.display()
        ))),
        (Some(why), _) => Err(CliError::Work(format!("the model is doubtful: {why}"))),
    }
}

/// Refuses, before minutes of work, a place where the new library cannot be.
fn room(options: &FitOptions) -> Result<(), CliError> {
    let Some(folder) = &options.output else { return Ok(()) };
    let real = |path: &Path| std::fs::canonicalize(path).ok();
    if real(folder).is_some_and(|folder| Some(folder) == real(Path::new(&options.library))) {
        return Err(StoreError::Reads { path: folder.clone(), read: options.library.clone().into() }.into());
    }
    Ok(Library::may_be_at(folder)?)
}

/// Where responses of the fitted model are wanted.
fn wanted(options: &FitOptions, surface: &Surface) -> Result<Vec<Point>, CliError> {
    let points = grid::places(&surface.outline, options.grid_mm, &options.at)?;
    if options.output.is_some() && points.is_empty() {
        return Err(CliError::Input(
            "-o: expected --grid-mm P or --at X,Y as well, the points of the new library, found neither"
                .into(),
        ));
    }
    Ok(points)
}
