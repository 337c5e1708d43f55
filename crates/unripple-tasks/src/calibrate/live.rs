//! Calibration through a device that plays and records at the same time.

use super::campaign::Campaign;
use super::devices::{self, Opened};
use super::filler::LibraryFiller;
use super::finish::{ASKED, PROBE_DELAY, begin, finish, log_run};
use super::hammer;
use super::outcome::doubted;
use super::points::{self, middle};
use super::rigs::People;
use super::taps;
use super::wires::{self, Found, WiringTestOptions};
use super::without_force::WithoutForce;
use super::{By, Hands, Report, before, figure, levels, report};
use crate::{TaskError, go_on};
use serde_json::Value;
use std::ops::ControlFlow;
use unripple::core::clock::Instant;
use unripple::core::{Device, Layout, Point};
use unripple_calibrate::measure::{
    Listen, MeasureOptions, Progress, Rig, Session, Sink, Way, Wires, campaign,
};
use unripple_devices::{Expected, WiringOptions, check_wiring};
use unripple_store::{Library, PointState};

/// Measures all points that are missing from the library, and reports on its quality.
pub(super) fn run(mut known: Campaign<'_>, hands: Hands) -> Result<Report, TaskError> {
    let (ask, surface) = (known.ask, known.surface);
    before::apply(ask, surface, &mut known.settings)?;
    known.warn();
    let people = People { hands, probe: ask.by == By::Probe, hammer: ask.by == By::Hammer };
    let Opened { mut rig, truth } = devices::open(&ask.device, surface, people)?;
    let layout = rig.device().layout().clone();
    let wires = Wires::by_name(&known.model.ports, &layout, &ask.wires)?;
    known.places = points::places(ask, surface, !wires.sensors.is_empty())?;
    if ask.check_levels {
        return Report::of_levels(&levels::listen(&known, rig.as_mut(), &layout, &wires)?);
    }
    let mut library = Library::create(&ask.output, &known.plan())?;
    agree(&known, &library)?;
    let began = library.in_state(PointState::Missing).len();
    let middle = middle(surface);
    known.go_on()?;
    let wired = wiring(&known, rig.as_mut(), &layout, middle)?;
    known.settings.without.clone_from(&wired.dead);
    same_dead(&known, &library)?;
    wires::tell(&known, &wired.notes, &wired.faults);
    wired.keep(&mut library)?;
    begin(&known, &mut library)?;
    let without = known.settings.without.clone();
    let mut filler = LibraryFiller::new(library, known.places.probed, surface, &known.scales, without);

    let places = &known.places;
    let first = Session::new(surface, &layout, wires.clone(), &known.settings)?;
    known.go_on()?;
    let latency = first.find_latency(rig.as_mut(), places.points.len(), middle, known.model)?;
    let late = latency.map_or(0.0, |found| found[0]);
    let settings = MeasureOptions { latency: late, ..known.settings.clone() };
    let mut session = Session::new(surface, &layout, wires.clone(), &settings)?;
    known.go_on()?;
    own(&known, &session, rig.as_mut(), &mut filler, middle)?;
    if let Some(sensors) = filler.heard()? {
        session.set_reference(&sensors)?;
    }
    let seconds = session.seconds();
    let (way, mut filler) = way_of(&known, session, filler, (&layout, &wires), &settings)?;
    let start = Instant::now();
    fill(&known, rig.as_mut(), &way, &mut filler, settings.retries)?;
    let taken = start.elapsed();
    finish(&known, &mut filler, latency)?;
    if began > 0 {
        log_run(&known, &mut filler.library, began, taken.as_secs_f64())?;
    }
    let report = report::Report::of(&filler.library, places, latency, truth.as_deref(), seconds, taken)?;
    let drawn = figure::write(&mut known, &filler.library);
    if let Err(TaskError::Cancelled) = drawn {
        return Err(TaskError::Cancelled);
    }
    Report::of_library(&report, doubted(&filler.library).or(drawn.err().map(|error| error.to_string())))
}

/// How points are measured, and the library to fill with what is measured so.
fn way_of(
    known: &Campaign<'_>,
    session: Session,
    filler: LibraryFiller,
    (layout, wires): (&Layout, &Wires),
    settings: &MeasureOptions,
) -> Result<(Way, LibraryFiller), TaskError> {
    if known.ask.by == By::Probe {
        return Ok((Way::Probe(Box::new(session)), filler));
    }
    let mut filler = filler.by_taps();
    let way = if known.ask.by == By::Hammer {
        Way::Hammer(Box::new(hammer::session(known, &filler, layout, wires, settings)?))
    } else {
        Way::Tap(Box::new(taps::session(known, &mut filler, layout, wires, settings)?))
    };
    Ok((way, filler))
}

/// Measures the missing points one by one, and repeats a bad one up to `retries` times.
fn fill(
    known: &Campaign<'_>,
    rig: &mut dyn Rig,
    way: &Way,
    filler: &mut LibraryFiller,
    retries: u64,
) -> Result<(), TaskError> {
    known.with_progress(|heard| {
        heard.stage("points");
        let mut tell = |progress: &Progress| {
            if let Some(fault) = &progress.fault {
                heard.tell(&format!("point {}: {fault}; kept as bad", progress.number + 1));
            }
            heard.done(progress.done as f64 / progress.total as f64);
            if heard.cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        campaign(rig, way, &known.places.points, filler, retries, &mut tell)?;
        go_on(heard)
    })
}

/// Whether a library has measured points already.
fn is_begun(library: &Library) -> bool {
    library.in_state(PointState::Missing).len() < library.points().len()
}

/// Returns an error if points of two scales, or of two delays of the probe, would be mixed in one library.
fn agree(known: &Campaign<'_>, library: &Library) -> Result<(), TaskError> {
    let here = known.scale_told();
    let other = library.logged("scale").filter(|there| is_begun(library) && **there != here);
    if let Some(there) = other {
        let said = |value: &Value| {
            let keys = ["input_all", "input", "output"].map(|key| format!("{key} {}", value[key]));
            keys.join(", ")
        };
        return Err(TaskError::Work(format!(
            "{}: expected the scales that its points were measured with ({}), found {}; use `input_scales` and `output_scale` as \
             then, or another library",
            library.path().display(),
            said(there),
            said(&here)
        )));
    }
    let said = |delay: Option<f64>| delay.map_or("none".to_owned(), |s| format!("{:.3} ms", 1e3 * s));
    let there = library.logged(ASKED).map(|asked| said(asked[PROBE_DELAY].as_f64()));
    let here = said(known.settings.probe_delay);
    match there.filter(|there| is_begun(library) && *there != here) {
        None => Ok(()),
        Some(there) => Err(TaskError::Work(format!(
            "{}: expected the `probe_delay_s` that its points were measured with ({there}), found {here}; give it as then, or use \
             another library",
            library.path().display()
        ))),
    }
}

/// Returns an error if other actuators are left out than for the points already in the library: their
/// responses are stored as zeros.
fn same_dead(known: &Campaign<'_>, library: &Library) -> Result<(), TaskError> {
    let (there, here) = (library.dead(), &known.settings.without);
    if !is_begun(library) || library.logged("scale").is_none() || there == *here {
        return Ok(());
    }
    let named = |dead: &[usize]| match dead {
        [] => "none".to_owned(),
        dead => {
            let names = dead.iter().map(|actuator| known.surface.actuators[*actuator].name.as_str());
            names.collect::<Vec<_>>().join(", ")
        }
    };
    Err(TaskError::Work(format!(
        "{}: expected the same actuators left out as when its points were measured ({}), found {}; use `without` as then, \
         repair what failed since, or use another library",
        library.path().display(),
        named(&there),
        named(here)
    )))
}

/// Tests the wiring, if the device has a sensor for each actuator.
fn wiring(
    known: &Campaign<'_>,
    rig: &mut dyn Rig,
    layout: &Layout,
    middle: Point,
) -> Result<Found, TaskError> {
    let (ask, model) = (known.ask, known.model);
    let sensing = layout.inputs.len() >= layout.outputs.len();
    if !sensing || layout.outputs.len() != model.ports.len() || !ask.wires.is_empty() {
        known.tell(
            "wiring: not tested, since channels do not correspond to actuators and their sensors by name",
        );
        return Ok(Found { dead: known.settings.without.clone(), ..Found::default() });
    }
    rig.ready(known.places.points.len(), middle, 1)?;
    let try_options = WiringOptions::for_surface(known.surface);
    let mut moving = WithoutForce::new(rig.device());
    let inputs = &moving.layout().inputs;
    let probe = (inputs.len() > layout.outputs.len()).then_some(middle);
    let expected = Expected::of(known.surface, model, probe, try_options.listen).map_err(TaskError::input)?;
    let found = check_wiring(&mut moving, &expected, &try_options).map_err(TaskError::work)?;
    WiringTestOptions::of(known).judge(&found)
}

/// Measures the responses from each actuator to the sensors of all, and stores them as the library's last
/// points.
fn own(
    known: &Campaign<'_>,
    session: &Session,
    rig: &mut dyn Rig,
    filler: &mut LibraryFiller,
    middle: Point,
) -> Result<(), TaskError> {
    let places = &known.places;
    let mut missing = filler.library.in_state(PointState::Missing);
    missing.retain(|point| *point >= places.probed);
    if missing.is_empty() {
        return Ok(());
    }
    let sensors = session.measure(rig, places.points.len(), middle, 2, Listen::Sensors)?;
    for point in missing {
        if let Some(channel) = sensors.get(point - places.probed) {
            let fault = session.fault(channel);
            filler.keep(point, channel, fault.as_deref())?;
        }
    }
    filler.reciprocity(&sensors)
}
