//! A drive on a surface: measured figures, and the notes that go with them.

use crate::error::CliError;
use indicatif::ProgressBar;
use serde::Serialize;
use std::time::Duration;
use unripple::core::{Contact, Point, Responses, Shape, Surface};
use unripple::field::{Aim, Field, Measured, Steepness, Trace};
use unripple::physics::design::{Linearity, linearity};
use unripple::physics::{PhysicsError, ResponseOptions, responses};

/// Accuracy of the frequencies where they take a mesh: a phase of 0.06 rad at 3 kHz after 30 ms, alike in drive and judgement.
const MESHED: f64 = 1e-4;

/// Cells of the grid per shortest wavelength.
pub const CELLS: f64 = 8.0;

/// A field longer than this, in seconds, takes long enough to measure that people should see it.
const LONG: f64 = 0.2;

/// A moving sign on a terminal that work goes on; nothing elsewhere.
fn waiting(what: String) -> ProgressBar {
    let spinner = ProgressBar::new_spinner().with_message(what);
    spinner.enable_steady_tick(Duration::from_millis(120));
    spinner
}

/// What a drive was found to do.
pub struct Judged {
    /// All figures and maps.
    pub measured: Measured,
    /// How each target moves, from the drive's first sample on; of a set, its first point.
    pub traces: Vec<Trace>,
    /// How far the traces go, in seconds.
    pub until: f64,
    /// How far from small the deflections are; `None` on a library's own points.
    pub linearity: Option<Linearity>,
    /// What linear theory cannot say, and other warnings.
    pub notes: Vec<Note>,
}

/// Something a reader of the figures must know.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Note {
    /// What it is about, in a word or two.
    pub topic: &'static str,
    /// The note.
    pub text: String,
}

/// Accuracy that a surface's frequencies are worth: of what takes a mesh, no more than a drive can tell.
pub fn accuracy(surface: &Surface) -> f64 {
    let plain = matches!(surface.outline.shape, Shape::Rectangle { .. })
        && surface.outline.holes.is_empty()
        && surface.sheet.uneven.is_nothing();
    if plain { ResponseOptions::default().accuracy } else { MESHED }
}

/// The responses of a surface, on modes up to `max_hz` if given, under fingers.
pub fn model(surface: &Surface, max_hz: Option<f64>, contacts: &[Contact]) -> Result<Responses, CliError> {
    let accuracy = accuracy(surface);
    let options =
        ResponseOptions { max_hz, accuracy, contacts: contacts.to_vec(), ..ResponseOptions::default() };
    responses(surface, &options).map_err(|error| match error {
        PhysicsError::NotConverged { .. } => CliError::work(error),
        error => CliError::input(error),
    })
}

/// Measures what the field of a drive is at the aims. Traces last until `until` seconds, or as long as the field is known.
pub fn judge(
    surface: &Surface,
    field: &Field,
    aims: &[Aim],
    period: Option<f64>,
    until: f64,
) -> Result<Judged, CliError> {
    let until = until.min(known(field));
    let spinner = (until > LONG).then(|| waiting(format!("measuring {until:.2} s of the whole surface")));
    let measured = field.measure(aims, period).map_err(CliError::input)?;
    if let Some(spinner) = spinner {
        spinner.finish_and_clear();
    }
    let first: Vec<Point> = aims.iter().filter_map(|aim| aim.points.first().copied()).collect();
    let traces = field.traces(&first, until).map_err(CliError::input)?;
    let linearity = small(surface, &measured);
    let notes = notes(surface, &measured, linearity.as_ref());
    Ok(Judged { measured, traces, until, linearity, notes })
}

/// The last instant at which a field is known, in seconds.
pub fn known(field: &Field) -> f64 {
    field.known().saturating_sub(1) as f64 / field.rate()
}

/// The largest displacement anywhere, in metres.
fn largest(measured: &Measured) -> f64 {
    let peak = measured.maps.peak_displacement.iter().fold(0.0, |m: f64, u| m.max(f64::from(u.abs())));
    measured.targets.iter().map(|t| t.peak_displacement_m.abs()).fold(peak, f64::max)
}

/// How far from small the deflections are. Slopes are known where targets are at their extreme; elsewhere the surface is
/// calmer, and what is more there is allowed for in proportion to the displacement.
fn small(surface: &Surface, measured: &Measured) -> Option<Linearity> {
    let steep = Steepness::of(&measured.maps)?;
    let largest = largest(measured);
    let taken = measured.maps.at_displacement_peak.iter().flat_map(|s| &s.displacement);
    let taken = taken.fold(0.0, |m: f64, u| m.max(f64::from(u.abs())));
    let more = if taken > 0.0 { (largest / taken).max(1.0) } else { 1.0 };
    let (slope, square) = (steep.slope * more, steep.mean_square_slope * more * more);
    Some(linearity(surface, largest, slope, square, steep.curvature * more))
}

fn notes(surface: &Surface, measured: &Measured, linearity: Option<&Linearity>) -> Vec<Note> {
    let mut notes = linearity.map_or_else(Vec::new, |found| linear_theory(surface, largest(measured), found));
    if measured.targets.iter().any(|target| !target.span_complete) {
        notes.push(Note {
            topic: "span",
            text: "the responses end before twice the focal instant: background figures are those of the part known".into(),
        });
    }
    notes
}

/// What a field with a displacement of `largest` metres puts in doubt.
fn linear_theory(surface: &Surface, largest: f64, found: &Linearity) -> Vec<Note> {
    let um = |metres: f64| metres * 1e6;
    let mut notes = Vec::new();
    let mut note = |text| notes.push(Note { topic: "linear theory", text });
    if found.displacement_over_thickness > 1.0 {
        note(format!(
            "the largest displacement, {:.0} µm, is above the sheet's thickness of {:.0} µm: the sheet would stretch as \
             much as it bends, and linear theory does not hold",
            um(largest),
            um(surface.sheet.thickness)
        ));
    }
    if let Some(change) = found.tension_change.filter(|change| *change > 0.1) {
        note(format!(
            "slopes of up to {:.3} add {:.1} N/m to the tension, {:.0} % of it: above 10 %, waves run faster where they are \
             high, and linear theory does not hold",
            found.slope,
            found.tension_added_n_per_m,
            100.0 * change
        ));
    }
    if let Some(share) = found.share_of_yield.filter(|share| *share > 1.0) {
        note(format!(
            "bending strains the faces by {:.2e} and stretching the middle by {:.2e}: with the tension, {share:.1} times the \
             strain at which the sheet yields",
            found.bending_strain, found.stretching_strain
        ));
    }
    notes
}
