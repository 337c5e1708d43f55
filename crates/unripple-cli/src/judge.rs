//! A drive on a surface: measured figures, and the notes that go with them.

use crate::error::CliError;
use indicatif::ProgressBar;
use serde::Serialize;
use std::time::Duration;
use unripple::core::{Point, Responses, Surface};
use unripple::field::{Aim, Field, Measured, Trace};
use unripple::physics::design::{Deformation, deformation};
use unripple::physics::{PhysicsError, ResponseOptions, responses};

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

/// The responses of a surface, on modes up to `max_hz` if given.
pub fn model(surface: &Surface, max_hz: Option<f64>) -> Result<Responses, CliError> {
    let options = ResponseOptions { max_hz, ..ResponseOptions::default() };
    responses(surface, &options).map_err(|error| match error {
        PhysicsError::NotConverged { .. } => CliError::work(error),
        error => CliError::input(error),
    })
}

/// Measures what the field of a drive is at the aims. Traces last until `until` seconds.
pub fn judge(
    surface: &Surface,
    field: &Field,
    aims: &[Aim],
    period: Option<f64>,
    until: f64,
) -> Result<Judged, CliError> {
    let spinner = (until > LONG).then(|| waiting(format!("measuring {until:.2} s of the whole surface")));
    let measured = field.measure(aims, period).map_err(CliError::input)?;
    if let Some(spinner) = spinner {
        spinner.finish_and_clear();
    }
    let first: Vec<Point> = aims.iter().filter_map(|aim| aim.points.first().copied()).collect();
    let traces = field.traces(&first, until).map_err(CliError::input)?;
    let notes = notes(surface, &measured);
    Ok(Judged { measured, traces, notes })
}

fn notes(surface: &Surface, measured: &Measured) -> Vec<Note> {
    let limits = deformation(surface);
    let peak = measured.maps.peak_displacement.iter().fold(0.0, |m: f64, u| m.max(f64::from(u.abs())));
    let largest = measured.targets.iter().map(|t| t.peak_displacement_m.abs()).fold(peak, f64::max);
    let mut notes = linear_theory(largest, &limits);
    if measured.targets.iter().any(|target| !target.span_complete) {
        notes.push(Note {
            topic: "span",
            text: "the responses end before twice the focal instant: background figures are those of the part known".into(),
        });
    }
    notes
}

/// What a displacement of `largest` metres puts in doubt.
pub fn linear_theory(largest: f64, limits: &Deformation) -> Vec<Note> {
    let um = |metres: f64| metres * 1e6;
    let mut notes = Vec::new();
    let mut note = |text| notes.push(Note { topic: "linear theory", text });
    let thickness = limits.linear_limit_thickness_m;
    if largest > thickness {
        note(format!(
            "the largest displacement, {:.0} µm, is above the sheet's thickness of {:.0} µm: the sheet would stretch as \
             much as it bends, and linear theory does not hold",
            um(largest),
            um(thickness)
        ));
    }
    if let Some(limit) = limits.linear_limit_tension_m.filter(|limit| largest > *limit) {
        note(format!(
            "the largest displacement, {:.0} µm, is above {:.0} µm, where a focus changes the tension by a tenth",
            um(largest),
            um(limit)
        ));
    }
    if let Some(limit) = limits.yield_amplitude_m.filter(|limit| largest > *limit) {
        note(format!(
            "the largest displacement, {:.0} µm, strains the sheet past its yield at the shortest wavelength, {:.0} µm",
            um(largest),
            um(limit)
        ));
    }
    notes
}
