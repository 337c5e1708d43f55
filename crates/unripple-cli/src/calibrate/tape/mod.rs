//! Calibration by files: what is to be played is written, what was recorded elsewhere is brought back.

mod plan;
mod rig;
mod takes;

use super::points::{self, Places};
use super::report::{self, Report};
use super::shelf::Shelf;
use super::{devices, middle};
use crate::args::{CalibrateOptions, WayName};
use crate::error::CliError;
use crate::output;
use plan::Wanted;
use rig::{TapeRig, TapeShelf, bad};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;
use takes::{Fault, Takes};
use unripple::core::{Layout, ModalResponses, PROBE, Surface};
use unripple_calibrate::measure::{
    Channel, Listen, MeasureOptions, Progress, Session, Sink, Way, Wires, campaign,
};
use unripple_devices::DevicesError;
use unripple_store::{Library, PointState};

/// Samples of a block: nothing waits for it, so that it only sets the silence at the beginning.
const BLOCK: usize = 256;

/// Recordings named one by one.
const LISTED: usize = 12;

impl From<DevicesError> for CliError {
    fn from(error: DevicesError) -> Self {
        Self::input(error)
    }
}

/// All that is known before anything was recorded.
struct Bench<'a> {
    options: &'a CalibrateOptions,
    surface: &'a Surface,
    model: &'a ModalResponses,
    settings: MeasureOptions,
    places: Places,
    wanted: Vec<Wanted>,
    folder: &'a Path,
}

/// What came of the recordings that are there.
#[derive(Default)]
struct Outcome {
    report: Option<Report>,
    faults: Vec<Fault>,
}

/// Writes what is to be played, or makes what there is of the library from the recordings that are there.
pub fn run(
    options: &CalibrateOptions,
    surface: &Surface,
    settings: &MeasureOptions,
    model: &ModalResponses,
    as_json: bool,
) -> Result<(), CliError> {
    let Some(folder) = options.device.tape.as_deref() else {
        return Err(CliError::Input(
            "--device tape: expected --tape DIR, a folder for recordings, found none".into(),
        ));
    };
    if options.by == WayName::Tap {
        return Err(CliError::Input("--by tap: expected --by probe with --device tape, found taps".into()));
    }
    // A bad recording is not better when it is read again.
    let settings = MeasureOptions { again: 0, ..settings.clone() };
    let layout = layout(options, surface)?;
    let wires = Wires::by_name(&model.ports, &layout, &devices::named(&options.wire)?)?;
    let places = points::places(options, surface, !wires.sensors.is_empty())?;
    if places.probed > 0 && wires.probe.is_none() {
        let found = layout.inputs.join(", ");
        return Err(CliError::Input(format!(
            "--tape-inputs: expected one that is called `{PROBE}`, found {found}"
        )));
    }
    let session = Session::new(surface, &layout, wires.clone(), &settings)?;
    let drive = plan::drive(&session, &layout, middle(surface))?;
    let band = session.band();
    let mut takes = Takes::new(folder.into(), layout, wires, band, drive);
    let wanted = plan::wanted(&places, !takes.telling().is_empty(), settings.repeats);
    let told = plan::told(&surface.name, &takes.layout, &takes.drive, &settings, &wanted);
    plan::put(folder, &told, &takes.drive)?;

    let bench = Bench { options, surface, model, settings, places, wanted, folder };
    let any = bench.wanted.iter().any(|one| bench.there(one));
    let outcome = match any && bench.own().iter().all(|one| bench.there(one)) {
        true => bench.measure(&session, &mut takes, as_json)?,
        false => Outcome::default(),
    };
    bench.answer(&outcome, &told, as_json)
}

/// The channels that recordings are to have.
fn layout(options: &CalibrateOptions, surface: &Surface) -> Result<Layout, CliError> {
    let names: Vec<String> = surface.actuators.iter().map(|actuator| actuator.name.clone()).collect();
    let inputs = match &options.device.tape_inputs[..] {
        [] => names.iter().cloned().chain([PROBE.to_owned()]).collect(),
        given => given.to_vec(),
    };
    if let Some(twice) = inputs.iter().enumerate().find(|(i, name)| inputs[..*i].contains(name)) {
        return Err(CliError::Input(format!(
            "--tape-inputs: expected each name once, found `{}` twice",
            twice.1
        )));
    }
    Ok(Layout {
        device: "tape".into(),
        rate: surface.emission.rate,
        block: BLOCK,
        outputs: names,
        inputs,
        full_scale: surface.emission.limit,
    })
}

impl Bench<'_> {
    fn there(&self, wanted: &Wanted) -> bool {
        self.folder.join(&wanted.file).is_file()
    }

    /// Recordings of the actuators themselves, without which no other can be used.
    fn own(&self) -> Vec<&Wanted> {
        self.wanted.iter().filter(|one| one.at.is_none()).collect()
    }

    /// Points all of whose recordings are there and can be used; what is wrong with others.
    fn usable(&self, takes: &mut Takes, missing: &[usize], faults: &mut Vec<Fault>) -> Vec<usize> {
        let mut usable = Vec::new();
        for point in missing {
            let own: Vec<&Wanted> = self.wanted.iter().filter(|one| one.number == *point).collect();
            if !own.iter().all(|one| self.there(one)) {
                continue;
            }
            let wrong: Vec<Fault> = own.iter().filter_map(|one| takes.take(one).err()).collect();
            if wrong.is_empty() {
                usable.push(*point);
            }
            faults.extend(wrong);
        }
        usable
    }

    /// Fills the library with all that can be made of the recordings.
    fn measure(&self, first: &Session, takes: &mut Takes, as_json: bool) -> Result<Outcome, CliError> {
        let start = Instant::now();
        let mut faults = Vec::new();
        if let Some(one) = self.own().first() {
            faults.extend(takes.learn(one).err());
        }
        if faults.is_empty() {
            faults.extend(self.own().iter().filter_map(|one| takes.take(one).err()));
        }
        if !faults.is_empty() {
            return Ok(Outcome { report: None, faults });
        }
        let plan = super::plan(self.options, self.surface, self.model, &self.places, &self.settings);
        let mut shelf =
            Shelf { library: Library::create(&self.options.output, &plan)?, probed: self.places.probed };
        let there = self.usable(takes, &shelf.missing(), &mut faults);

        let (last, centre) = (self.places.points.len(), middle(self.surface));
        let mut rig = TapeRig::new(takes.clone(), self.wanted.clone(), self.settings.repeats)?;
        let latency = first.find_latency(&mut rig, last, centre, self.model)?;
        let settings =
            MeasureOptions { latency: latency.map_or(0.0, |found| found[0]), ..self.settings.clone() };
        let session = Session::new(self.surface, &takes.layout, takes.wires.clone(), &settings)?;
        faults.extend(self.keep_own(&session, &mut rig, &mut shelf)?);

        let bar = report::bar(as_json, there.len());
        let mut tell = |progress: &Progress| {
            // What is not kept is told of in the end.
            report::tell(&bar, &Progress { fault: None, ..progress.clone() });
        };
        let seconds = session.seconds();
        let way = Way::Probe(Box::new(session));
        let keep_bad = self.options.any_wiring;
        let mut sink =
            TapeShelf { shelf: &mut shelf, there, wanted: &self.wanted, keep_bad, faults: Vec::new() };
        campaign(&mut rig, &way, &self.places.points, &mut sink, settings.again, &mut tell)?;
        faults.append(&mut sink.faults);
        bar.finish_and_clear();
        let report = Report::of(&shelf.library, &self.places, latency, None, seconds, start.elapsed())?;
        Ok(Outcome { report: Some(report), faults })
    }

    /// What actuators hear of each other, kept as the library's last points unless it is bad.
    fn keep_own(
        &self,
        session: &Session,
        rig: &mut TapeRig,
        shelf: &mut Shelf,
    ) -> Result<Vec<Fault>, CliError> {
        let (last, centre) = (self.places.points.len(), middle(self.surface));
        let missing = shelf.library.in_state(PointState::Missing);
        if !missing.iter().any(|point| *point >= self.places.probed) {
            return Ok(Vec::new());
        }
        if self.options.any_wiring {
            super::own(session, rig, shelf, &self.places, centre)?;
            return Ok(Vec::new());
        }
        let sensors = session.measure(rig, last, centre, 0, Listen::Sensors)?;
        let names = self.surface.actuators.iter().map(|actuator| &actuator.name);
        let said = |(name, channel): (&String, &Channel)| {
            session.fault(channel).map(|why| bad(&self.wanted[0].file, &format!("sensor of `{name}`, {why}")))
        };
        let faults: Vec<Fault> = names.zip(&sensors).filter_map(said).collect();
        if faults.is_empty() {
            for (point, channel) in (self.places.probed..).zip(&sensors) {
                shelf.keep(point, channel, None)?;
            }
            shelf.reciprocity(&sensors)?;
        }
        Ok(faults)
    }

    /// Says what was made, what is still to be recorded, and what is wrong.
    fn answer(&self, outcome: &Outcome, told: &Value, as_json: bool) -> Result<(), CliError> {
        let missing: Vec<&Wanted> = self.wanted.iter().filter(|one| !self.there(one)).collect();
        let mut report = match &outcome.report {
            Some(report) => serde_json::to_value(report).map_err(CliError::work)?,
            None => json!({}),
        };
        if let Some(report) = report.as_object_mut() {
            let faults: Vec<Value> = outcome.faults.iter().map(Fault::json).collect();
            let files: Vec<&String> = missing.iter().map(|one| &one.file).collect();
            let tape = json!({
                "folder": self.folder.display().to_string(),
                "play": told["play"],
                "duration_s": told["duration_s"],
                "missing": files,
                "wrong": faults,
            });
            report.insert("tape".into(), tape);
        }
        let mut text = outcome.report.as_ref().map_or_else(String::new, Report::text);
        text += &self.wanting(&missing, told);
        output::answer(as_json, &report, &text)?;
        if outcome.faults.is_empty() {
            return Ok(());
        }
        let faults: Vec<String> = outcome.faults.iter().map(|fault| format!("  {fault}")).collect();
        Err(CliError::Work(format!("{} cannot be used:\n{}", recordings(faults.len()), faults.join("\n"))))
    }

    /// What is still to be recorded, and how.
    fn wanting(&self, missing: &[&Wanted], told: &Value) -> String {
        if missing.is_empty() {
            return String::new();
        }
        let list = |key: &str| {
            let names = told[key].as_array().into_iter().flatten().filter_map(Value::as_str);
            names.collect::<Vec<_>>().join(", ")
        };
        let mut text = format!(
            "{} to be made in {}, while play.wav plays ({:.1} s, channels {}; full scale is the surface's limit),\n\
             as WAV at {} Hz with the channels {}, from before it begins until after it ends:\n",
            recordings(missing.len()),
            self.folder.display(),
            told["duration_s"].as_f64().unwrap_or(0.0),
            list("outputs"),
            told["sample_rate_hz"].as_f64().unwrap_or(0.0),
            list("inputs"),
        );
        for one in missing.iter().take(LISTED) {
            let at = one.at.map_or_else(|| "anywhere".to_owned(), |at| format!("at {at}"));
            let _ = writeln!(text, "  {:20} the probe {at}", one.file);
        }
        if missing.len() > LISTED {
            let _ = writeln!(text, "  and {} more, see plan.json", missing.len() - LISTED);
        }
        text + "then the same command again, now or after each\n"
    }
}

fn recordings(count: usize) -> String {
    if count == 1 { "1 recording".into() } else { format!("{count} recordings") }
}
