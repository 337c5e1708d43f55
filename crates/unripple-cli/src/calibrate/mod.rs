//! `unripple calibrate`: responses measured through a device, point by point, into a library.

pub mod devices;
mod points;
mod report;
mod rigs;
mod shelf;
mod tape;

use crate::args::{CalibrateOptions, DeviceName, WayName};
use crate::error::CliError;
use crate::targets::positive;
use crate::{input, judge, output};
use devices::Opened;
use points::Places;
use report::Report;
use shelf::Shelf;
use std::collections::BTreeMap;
use std::time::Instant;
use unripple::core::{ModalResponses, Point, Responses, Surface};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{
    Listen, MeasureOptions, Progress, Rig, Session, TapOptions, TapSession, Way, Wires, campaign,
};
use unripple_devices::{Expected, WiringOptions, check_wiring};
use unripple_store::{Library, LibraryPlan, PointState};

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

pub fn run(options: &CalibrateOptions, as_json: bool) -> Result<(), CliError> {
    let surface = input::surface(&options.surface)?;
    let settings = settings(options)?;
    Library::may_be_at(&options.output)?;
    let Responses::Modal(model) = judge::model(&surface, None, &[])? else {
        return Err(CliError::Input("expected a surface, found responses at points".into()));
    };
    if options.device.device == DeviceName::Tape {
        return tape::run(options, &surface, &settings, &model, as_json);
    }
    let Opened { mut rig, truth } = devices::open(&options.device, &surface)?;
    let layout = rig.device().layout().clone();
    let wires = Wires::by_name(&model.ports, &layout, &devices::named(&options.wire)?)?;
    let places = points::places(options, &surface, !wires.sensors.is_empty())?;
    let library = Library::create(&options.output, &plan(options, &surface, &model, &places, &settings))?;
    let mut shelf = Shelf { library, probed: places.probed };
    let began = shelf.library.in_state(PointState::Missing).len();
    let middle = middle(&surface);
    wiring(options, rig.as_mut(), &model, &places, middle)?;

    let first = Session::new(&surface, &layout, wires.clone(), &settings)?;
    let latency = first.find_latency(rig.as_mut(), places.points.len(), middle, &model)?;
    let settings = MeasureOptions { latency: latency.map_or(0.0, |found| found[0]), ..settings };
    let session = Session::new(&surface, &layout, wires.clone(), &settings)?;
    own(&session, rig.as_mut(), &mut shelf, &places, middle)?;
    let seconds = session.seconds();
    let way = match options.by {
        WayName::Probe => Way::Probe(Box::new(session)),
        WayName::Tap => {
            let taps = TapOptions::default();
            Way::Tap(Box::new(TapSession::new(&surface, &layout, &wires, model, &settings, taps)?))
        }
    };
    let bar = report::bar(as_json, began);
    let start = Instant::now();
    let mut tell = |progress: &Progress| report::tell(&bar, progress);
    campaign(rig.as_mut(), &way, &places.points, &mut shelf, settings.again, &mut tell)?;
    bar.finish_and_clear();
    let report = Report::of(&shelf.library, &places, latency, truth.as_deref(), seconds, start.elapsed())?;
    output::answer(as_json, &report, &report.text())
}

fn settings(options: &CalibrateOptions) -> Result<MeasureOptions, CliError> {
    let ms = |value: f64, option: &str| Ok::<f64, CliError>(positive(value, option, "ms")? / 1e3);
    if options.repeats == 0 {
        return Err(CliError::Input("--repeats: expected 1 or more, found 0".into()));
    }
    Ok(MeasureOptions {
        sweep: ms(options.sweep_ms, "--sweep-ms")?,
        kept: ms(options.response_ms, "--response-ms")?,
        level: positive(options.level, "--level", "of the limit")?,
        repeats: options.repeats,
        ..MeasureOptions::default()
    })
}

fn middle(surface: &Surface) -> Point {
    let (width, height) = surface.outline.extent();
    Point::new(width / 2.0, height / 2.0)
}

/// What the library is to hold.
fn plan(
    options: &CalibrateOptions,
    surface: &Surface,
    model: &ModalResponses,
    places: &Places,
    settings: &MeasureOptions,
) -> LibraryPlan {
    let by = format!("{:?}", options.by).to_lowercase();
    let provenance = BTreeMap::from([
        ("software".to_owned(), format!("unripple {}", env!("CARGO_PKG_VERSION"))),
        ("device".to_owned(), format!("{:?}", options.device.device).to_lowercase()),
        ("by".to_owned(), by),
        ("probed points".to_owned(), places.probed.to_string()),
        ("sweep s".to_owned(), settings.sweep.to_string()),
        ("swept Hz".to_owned(), settings.swept(surface).map(|hz| hz.to_string()).join(" ")),
        ("repeats".to_owned(), settings.repeats.to_string()),
        ("level".to_owned(), settings.level.to_string()),
    ]);
    let samples = settings.samples(surface.emission.rate);
    let known =
        LibraryPlan::new(model.ports.clone(), places.points.clone(), model.conditions.clone(), samples);
    LibraryPlan { surface: Some(surface.clone()), provenance, ..known }
}

/// Tries the wires, where the device has a sensor for each actuator.
fn wiring(
    options: &CalibrateOptions,
    rig: &mut dyn Rig,
    model: &ModalResponses,
    places: &Places,
    middle: Point,
) -> Result<(), CliError> {
    let layout = rig.device().layout().clone();
    let sensing = layout.inputs.len() >= layout.outputs.len();
    if !sensing || layout.outputs.len() != model.ports.len() || !options.wire.is_empty() {
        eprintln!(
            "wiring: not tried, since channels do not correspond to actuators and their sensors by name"
        );
        return Ok(());
    }
    rig.ready(places.points.len(), middle, 1)?;
    let try_options = WiringOptions::for_band(model.conditions.band);
    let probe = (layout.inputs.len() > layout.outputs.len()).then_some(middle);
    let expected = Expected::of_modes(model, probe, try_options.listen);
    let found = check_wiring(rig.device(), &expected, &try_options).map_err(CliError::work)?;
    let faults = found.faults();
    if faults.is_empty() || options.any_wiring {
        faults.iter().for_each(|fault| eprintln!("wiring: {fault}"));
        return Ok(());
    }
    let faults = faults.join("; ");
    Err(CliError::Work(format!("wiring: {faults} (mend it, or go on with --any-wiring)")))
}

/// What actuators hear of each other and of themselves, as the library's last points.
fn own(
    session: &Session,
    rig: &mut dyn Rig,
    shelf: &mut Shelf,
    places: &Places,
    middle: Point,
) -> Result<(), CliError> {
    let mut missing = shelf.library.in_state(PointState::Missing);
    missing.retain(|point| *point >= places.probed);
    if missing.is_empty() {
        return Ok(());
    }
    let sensors = session.measure(rig, places.points.len(), middle, 2, Listen::Sensors)?;
    for point in missing {
        if let Some(channel) = sensors.get(point - places.probed) {
            let fault = session.fault(channel);
            unripple_calibrate::measure::Sink::keep(shelf, point, channel, fault.as_deref())?;
        }
    }
    shelf.reciprocity(&sensors)
}
