//! `unripple calibrate`: responses measured through a device, point by point, into a library.

pub mod before;
pub mod devices;
mod figure;
mod finish;
mod levels;
mod live;
mod points;
mod report;
mod rigs;
mod scale;
mod shelf;
mod tape;
mod verify;
mod wires;

use crate::args::{CalibrateOptions, DeviceName, WayName};
use crate::error::CliError;
use crate::targets::positive;
use crate::{input, judge, output};
use points::Places;
use scale::Scales;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{ModalResponses, Point, Responses, Surface};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::MeasureOptions;
use unripple_store::{Library, LibraryPlan, OutputDir};

impl From<CalibrateError> for CliError {
    fn from(error: CalibrateError) -> Self {
        match error {
            CalibrateError::Device(_)
            | CalibrateError::Gap { .. }
            | CalibrateError::Rig { .. }
            | CalibrateError::Sink { .. } => Self::work(error),
            error => Self::input(error),
        }
    }
}

/// All that is known before anything is measured.
pub struct Campaign<'a> {
    pub options: &'a CalibrateOptions,
    pub surface: &'a Surface,
    pub model: &'a ModalResponses,
    pub settings: MeasureOptions,
    pub scales: Scales,
    pub places: Places,
    /// Where a figure is to be, if one is asked for.
    pub figure: Option<OutputDir>,
}

pub fn run(options: &CalibrateOptions, as_json: bool) -> Result<(), CliError> {
    let surface = input::surface(&options.surface)?;
    let scales = Scales::of(options, &surface)?;
    check(options, &surface, &scales)?;
    Library::may_be_at(&options.output)?;
    let figure = figure::folder(options)?;
    let Responses::Modal(model) = judge::model(&surface, None, &[])? else {
        return Err(CliError::Input("expected a surface, found responses at points".into()));
    };
    let settings = settings(options, &surface, &model)?;
    let places = Places::default();
    let campaign = Campaign { options, surface: &surface, model: &model, settings, scales, places, figure };
    match options.device.device {
        DeviceName::Tape => tape::run(campaign, as_json),
        _ => live::run(campaign, as_json),
    }
}

/// Refuses numbers that make no sense, before there is a model.
fn check(options: &CalibrateOptions, surface: &Surface, scales: &Scales) -> Result<(), CliError> {
    let level = positive(options.level, "--level", "of the limit")?;
    within(level, scales, surface)?;
    without(options, surface).map(drop)
}

/// How to measure: as asked, and else as suits what the model rings like.
fn settings(
    options: &CalibrateOptions,
    surface: &Surface,
    model: &ModalResponses,
) -> Result<MeasureOptions, CliError> {
    let usual = MeasureOptions::for_model(model);
    let ms = |value: Option<f64>, usual: f64, option: &str| {
        value.map_or(Ok::<f64, CliError>(usual), |value| Ok(positive(value, option, "ms")? / 1e3))
    };
    if options.repeats == 0 {
        return Err(CliError::Input("--repeats: expected 1 or more, found 0".into()));
    }
    if let Some(delay) = options.probe_delay_ms.filter(|delay| !delay.is_finite()) {
        return Err(CliError::Input(format!("--probe-delay-ms: expected a number of ms, found {delay}")));
    }
    Ok(MeasureOptions {
        sweep: ms(options.sweep_ms, usual.sweep, "--sweep-ms")?,
        kept: ms(options.response_ms, usual.kept, "--response-ms")?,
        level: positive(options.level, "--level", "of the limit")?,
        repeats: options.repeats,
        probe_delay: options.probe_delay_ms.map(|ms| ms / 1e3),
        model: !options.no_model,
        without: without(options, surface)?,
        ..usual
    })
}

/// Actuators that are not to be measured.
fn without(options: &CalibrateOptions, surface: &Surface) -> Result<Vec<usize>, CliError> {
    let names = || surface.actuators.iter().map(|actuator| actuator.name.as_str());
    let mut found = Vec::new();
    for name in &options.without {
        match names().position(|other| other == name) {
            Some(actuator) => found.push(actuator),
            None => {
                let names = names().collect::<Vec<_>>().join(", ");
                return Err(CliError::Input(format!(
                    "--without {name}: expected one of {names}, found another"
                )));
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    if found.len() == surface.actuators.len() {
        return Err(CliError::Input("--without: expected an actuator that is left, found none".into()));
    }
    Ok(found)
}

/// Refuses a drive that is more than full scale.
fn within(level: f64, scales: &Scales, surface: &Surface) -> Result<(), CliError> {
    if level > 1.0 {
        return Err(CliError::Input(format!("--level: expected at most 1, found {level}")));
    }
    let (limit, full) = (surface.emission.limit, scales.full_scale(surface));
    if level * limit <= full * (1.0 + 1e-9) {
        return Ok(());
    }
    let most = full / limit;
    Err(CliError::Input(format!(
        "--level: expected at most {most:.3}, since --output-scale {full} is less than the surface's limit of {limit}, found {level}"
    )))
}

/// Says what is too short for the surface.
fn warn(settings: &MeasureOptions, model: &ModalResponses) {
    settings.warnings(model).iter().for_each(|warning| eprintln!("warning: {warning}"));
}

fn middle(surface: &Surface) -> Point {
    let (width, height) = surface.outline.extent();
    Point::new(width / 2.0, height / 2.0)
}

impl Campaign<'_> {
    /// What the library is to hold.
    fn plan(&self) -> LibraryPlan {
        let (options, settings, surface) = (self.options, &self.settings, self.surface);
        let by = format!("{:?}", options.by).to_lowercase();
        let provenance = BTreeMap::from([
            ("software".to_owned(), format!("unripple {}", env!("CARGO_PKG_VERSION"))),
            ("device".to_owned(), format!("{:?}", options.device.device).to_lowercase()),
            ("by".to_owned(), by),
            (PROBED.to_owned(), self.places.probed.to_string()),
            (before::SWEEP.to_owned(), settings.sweep.to_string()),
            (before::SWEPT.to_owned(), settings.swept(surface).map(|hz| hz.to_string()).join(" ")),
            ("repeats".to_owned(), settings.repeats.to_string()),
            ("level".to_owned(), settings.level.to_string()),
        ]);
        let samples = settings.samples(surface.emission.rate);
        let (ports, conditions) = (self.model.ports.clone(), self.model.conditions.clone());
        let known = LibraryPlan::new(ports, self.places.points.clone(), conditions, samples);
        LibraryPlan { surface: Some(surface.clone()), provenance, ..known }
    }

    /// What is known of scales, for the log. By taps the model says how strong they are.
    fn scale_told(&self) -> Value {
        match self.options.by {
            WayName::Probe => self.scales.told(),
            WayName::Tap => json!({ "by": "the model, tap by tap" }),
        }
    }
}

/// The key of a plan's provenance that counts the points measured by a probe or by taps.
const PROBED: &str = "probed points";

/// Prints the report; a doubtful library is failed work.
fn answer(
    as_json: bool,
    library: &Library,
    report: &impl serde::Serialize,
    text: &str,
) -> Result<(), CliError> {
    output::answer(as_json, report, text)?;
    trusted(library)
}

/// An error if a library is doubtful, with all reasons.
fn trusted(library: &Library) -> Result<(), CliError> {
    let doubts: Vec<String> = library.doubts().iter().map(|doubt| format!("  {doubt}")).collect();
    if doubts.is_empty() {
        return Ok(());
    }
    let text = format!("{} is doubtful:\n{}", library.path().display(), doubts.join("\n"));
    Err(CliError::Work(text))
}
