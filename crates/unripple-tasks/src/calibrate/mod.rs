//! `calibrate`: responses measured through a device, point by point, into a library.

mod ask;
pub(crate) mod before;
mod devices;
mod figure;
mod finish;
mod hands;
mod levels;
mod live;
mod outcome;
mod points;
mod report;
mod rigs;
mod scale;
mod shelf;
mod tape;
mod verify;
mod wires;

pub use ask::{Ask, By, InputScales};
pub(crate) use devices::{open, open_under};
pub use hands::{Hands, nobody};
pub use levels::Levels;
pub use outcome::Report;
pub use report::Report as LibraryReport;

use crate::numbers::above_zero;
use crate::{DeviceKind, Progress, TaskError, go_on, judge};
use points::Places;
use scale::Scales;
use serde_json::{Value, json};
use std::cell::RefCell;
use std::collections::BTreeMap;
use unripple::core::{ModalResponses, Point, Responses, Surface};
use unripple_calibrate::measure::MeasureOptions;
use unripple_store::{Library, LibraryPlan, OutputDir};

/// All that is known before anything is measured.
pub(crate) struct Campaign<'a> {
    /// The question that the task was asked.
    pub ask: &'a Ask,
    /// The surface as its file has it.
    pub surface: &'a Surface,
    /// Model of the surface, from its file.
    pub model: &'a ModalResponses,
    /// How responses are measured.
    pub settings: MeasureOptions,
    /// Values at full scale of inputs and outputs.
    pub scales: Scales,
    /// The places to be measured.
    pub places: Places,
    /// Where a figure is to be, if one is asked for.
    pub figure: Option<OutputDir>,
    /// The callback that reports progress.
    progress: RefCell<&'a mut dyn Progress>,
}

/// Measures responses through a device and stores them in a library. With recordings made elsewhere (tape) it writes the file to play, then
/// reads the recordings. For devices that need no person at the surface; for others see [`run_with`].
///
/// # Errors
/// Those of [`run_with`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    run_with(ask, nobody(), progress)
}

/// Measures responses as [`run()`] does; `hands` asks a person to move the probe or to tap. A cancelled run leaves the library as it is, to
/// be continued.
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of surfaces, devices, files and measurements; [`TaskError::Cancelled`].
pub fn run_with(ask: &Ask, hands: Hands, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    let scales = Scales::of(ask, &surface)?;
    check(ask, &surface, &scales)?;
    Library::may_be_at(&ask.output)?;
    let figure = figure::place(ask)?;
    go_on(progress)?;
    let Responses::Modal(model) = judge::model(&surface, None, &[])? else {
        return Err(TaskError::Input("expected a surface, found responses at points".into()));
    };
    let settings = settings(ask, &surface, &model)?;
    let (places, progress) = (Places::default(), RefCell::new(progress));
    let campaign =
        Campaign { ask, surface: &surface, model: &model, settings, scales, places, figure, progress };
    match ask.device.device {
        DeviceKind::Tape => tape::run(campaign),
        _ => live::run(campaign, hands),
    }
}

/// Refuses numbers that make no sense, before there is a model.
fn check(ask: &Ask, surface: &Surface, scales: &Scales) -> Result<(), TaskError> {
    let level = above_zero(ask.level, "level", "of the limit")?;
    within(level, scales, surface)?;
    without(ask, surface).map(drop)
}

/// How to measure: as asked, and else as suits what the model rings like.
fn settings(ask: &Ask, surface: &Surface, model: &ModalResponses) -> Result<MeasureOptions, TaskError> {
    let usual = MeasureOptions::for_model(model);
    let length = |value: Option<f64>, usual: f64, field: &'static str| {
        value.map_or(Ok(usual), |value| above_zero(value, field, "s"))
    };
    if ask.repeats == 0 {
        return Err(TaskError::Input("`repeats`: expected 1 or more, found 0".into()));
    }
    if let Some(delay) = ask.probe_delay_s.filter(|delay| !delay.is_finite()) {
        return Err(TaskError::Input(format!("`probe_delay_s`: expected a finite time in s, found {delay}")));
    }
    Ok(MeasureOptions {
        sweep: length(ask.sweep_s, usual.sweep, "sweep_s")?,
        response_length: length(ask.response_s, usual.response_length, "response_s")?,
        level: above_zero(ask.level, "level", "of the limit")?,
        repeats: ask.repeats,
        probe_delay: ask.probe_delay_s,
        model: !ask.no_model,
        without: without(ask, surface)?,
        ..usual
    })
}

/// Actuators that are not to be measured.
fn without(ask: &Ask, surface: &Surface) -> Result<Vec<usize>, TaskError> {
    let names = || surface.actuators.iter().map(|actuator| actuator.name.as_str());
    let mut found = Vec::new();
    for name in &ask.without {
        match names().position(|other| other == name) {
            Some(actuator) => found.push(actuator),
            None => {
                let names = names().collect::<Vec<_>>().join(", ");
                return Err(TaskError::Input(format!(
                    "`without` {name}: expected one of {names}, found another"
                )));
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    if found.len() == surface.actuators.len() {
        return Err(TaskError::Input("`without`: expected an actuator that is left, found none".into()));
    }
    Ok(found)
}

/// Refuses a drive that is more than full scale.
fn within(level: f64, scales: &Scales, surface: &Surface) -> Result<(), TaskError> {
    if level > 1.0 {
        return Err(TaskError::Input(format!("`level`: expected at most 1, found {level}")));
    }
    let (limit, full) = (surface.emission.limit, scales.full_scale(surface));
    if level * limit <= full * (1.0 + 1e-9) {
        return Ok(());
    }
    let most = full / limit;
    Err(TaskError::Input(format!(
        "`level`: expected at most {most:.3}, since `output_scale` {full} is less than the surface's limit of {limit}, found {level}"
    )))
}

pub(crate) fn middle(surface: &Surface) -> Point {
    let (width, height) = surface.outline.extent();
    Point::new(width / 2.0, height / 2.0)
}

impl Campaign<'_> {
    /// Shows people a line.
    pub fn tell(&self, line: &str) {
        self.progress.borrow_mut().tell(line);
    }

    /// Hands out the callback that reports progress.
    pub fn with_progress<T>(&self, work: impl FnOnce(&mut dyn Progress) -> T) -> T {
        work(*self.progress.borrow_mut())
    }

    /// Returns an error if the task has been cancelled.
    ///
    /// # Errors
    /// [`TaskError::Cancelled`].
    pub fn go_on(&self) -> Result<(), TaskError> {
        self.with_progress(|progress| go_on(progress))
    }

    /// Says what is too short for the surface.
    fn warn(&self) {
        self.settings
            .warnings(self.model)
            .iter()
            .for_each(|warning| self.tell(&format!("warning: {warning}")));
    }

    /// What the library is to hold.
    fn plan(&self) -> LibraryPlan {
        let (ask, settings, surface) = (self.ask, &self.settings, self.surface);
        let by = format!("{:?}", ask.by).to_lowercase();
        let provenance = BTreeMap::from([
            ("software".to_owned(), format!("unripple {}", env!("CARGO_PKG_VERSION"))),
            ("device".to_owned(), format!("{:?}", ask.device.device).to_lowercase()),
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

    /// Scales of the inputs and outputs, for the log. With taps the model tells their strength.
    fn scale_told(&self) -> Value {
        match self.ask.by {
            By::Probe => self.scales.told(),
            By::Tap => json!({ "by": "the model, tap by tap" }),
        }
    }
}

/// The key of a plan's provenance that counts the points measured by a probe or by taps.
const PROBED: &str = "probed points";

/// Why a library is doubtful, if it is: all reasons.
fn doubted(library: &Library) -> Option<String> {
    let doubts: Vec<String> = library.doubts().iter().map(|doubt| format!("  {doubt}")).collect();
    if doubts.is_empty() {
        return None;
    }
    Some(format!("{} is doubtful:\n{}", library.path().display(), doubts.join("\n")))
}
