//! Computes the library from the recordings that exist.

use super::fault::Fault;
use super::library::{library_of, outdated};
use super::marks::Marks;
use super::planned::Wanted;
use super::rig::{TapeLibraryFiller, TapeRig, bad};
use super::wiring::{Failed, WiringResult, test_wiring};
use super::{Outcome, TapeCalibration};
use crate::TaskError;
use crate::calibrate::filler::LibraryFiller;
use crate::calibrate::finish::{begin, finish, log_run};
use crate::calibrate::middle;
use crate::calibrate::report::Report;
use crate::calibrate::wires::{self, WIRING};
use serde_json::{Value, json};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;
use unripple::core::clock::Instant;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Listen, MeasureOptions, Session, Sink};
use unripple_store::{Doubt, Library, PointState};

impl TapeCalibration<'_> {
    /// Fills the library with all responses that can be computed from the recordings.
    pub fn measure(&mut self, first: &Session) -> Result<Outcome, TaskError> {
        let start = Instant::now();
        let there = Some(&self.campaign.ask.output).filter(|folder| Library::is_at(folder));
        let there = there.map(Library::open).transpose()?;
        let present = self.present();
        let marks = Marks::of(self.folder, present.iter(), there.as_ref());
        let mut faults = marks.copies(&self.trusted(there.as_ref(), &marks));
        drop(there);
        let own: Vec<Wanted> = present.iter().filter(|one| one.at.is_none()).cloned().collect();
        faults.retain(|fault| own.iter().all(|one| one.file != fault.file) || own.len() > 1);
        if let Some(one) = own.first() {
            faults.extend(self.takes.learn(one).err());
        }
        faults.extend(own.iter().filter_map(|one| self.takes.take(one).err()));
        if faults.iter().any(|fault| own.iter().any(|one| one.file == fault.file)) {
            return Ok(Outcome { faults, ..Outcome::default() });
        }
        let mut library = library_of(&self.campaign)?;
        let made_own = self.made_own(&present, &marks);
        self.fall_back(&mut library, &self.made(&present, &marks), made_own.as_ref())?;
        let sound = self.sound(&present, &library, &mut faults);
        self.good = sound.iter().map(|one| one.number).collect::<BTreeSet<_>>().into_iter().collect();
        let all: Vec<Wanted> = own.into_iter().chain(sound).collect();

        let mut rig = TapeRig::new(self.takes.clone(), all.clone())?;
        let wiring = match test_wiring(self, first, &mut rig) {
            Err(Failed::Recording(why)) => {
                let files: Vec<String> =
                    all.iter().filter(|one| one.at.is_none()).map(|one| one.file.clone()).collect();
                faults.push(bad(&files.join(", "), &why));
                return Ok(Outcome { faults, ..Outcome::default() });
            }
            Err(Failed::Other(error)) => return Err(error),
            Ok(wiring) => wiring,
        };
        self.wires(&mut library, &wiring)?;
        self.campaign.settings.without = wiring.dead.clone();
        marks.keep(&mut library)?;
        begin(&self.campaign, &mut library)?;
        let made = self.made(&all, &marks);
        let mut work = Work { calibration: self, rig, made, made_own, all, faults, known: None, start };
        let (filler, report) = work.fill(library, &wiring)?;
        let faults = std::mem::take(&mut work.faults);
        Ok(Outcome { report: Some(report), library: Some(filler.library), faults, notes: wiring.notes })
    }

    /// Files from which stored points were measured and which are unchanged: where another file is a copy,
    /// that one is at fault.
    fn trusted(&self, library: Option<&Library>, marks: &Marks) -> Vec<String> {
        let Some(library) = library else { return Vec::new() };
        let logged = (0..library.points().len()).filter_map(|point| library.logged_point(point));
        let files = logged.filter_map(|said| said["made"]["takes"].as_object()).flatten();
        let same = files.filter(|(file, hash)| marks.hash(file) == hash.as_str());
        same.map(|(file, _)| file.clone()).collect()
    }

    /// For each point, the data from which its responses are computed: its own recordings, those of the actuators, scales, and the
    /// actuators that are left out.
    fn made(&self, there: &[Wanted], marks: &Marks) -> BTreeMap<usize, Value> {
        let of = |number: usize| there.iter().filter(move |one| one.number == number);
        let (last, scale) = (self.campaign.places.points.len(), self.campaign.scales.told());
        let numbers: BTreeSet<usize> = there.iter().map(|one| one.number).collect();
        let point = |number: usize| {
            json!({
                "takes": marks.told(of(number)),
                "actuators": marks.told(of(last)),
                "scale": scale,
                "without": self.campaign.ask.without,
                "probe_delay_s": self.campaign.settings.probe_delay,
            })
        };
        numbers.into_iter().filter(|number| *number != last).map(|number| (number, point(number))).collect()
    }

    /// The data from which the points at the actuators are computed; `None` if there is no recording of the
    /// actuators.
    fn made_own(&self, there: &[Wanted], marks: &Marks) -> Option<Value> {
        let last = self.campaign.places.points.len();
        let own: Vec<&Wanted> = there.iter().filter(|one| one.number == last).collect();
        (!own.is_empty()).then(|| {
            json!({
                "actuators": marks.told(own.into_iter()),
                "scale": self.campaign.scales.told(),
                "without": self.campaign.ask.without,
            })
        })
    }

    /// Marks points as missing if their recordings, scales or options changed since they were computed; all
    /// points, if those of the actuators' recording did.
    fn fall_back(
        &self,
        library: &mut Library,
        made: &BTreeMap<usize, Value>,
        made_own: Option<&Value>,
    ) -> Result<(), TaskError> {
        let measured = |point: &usize| library.state(*point) != Some(PointState::Missing);
        let mut changed = outdated(library, made);
        let own = self.campaign.places.probed..library.points().len();
        // Libraries of before do not say who was left out.
        let same = |there: &Value| {
            let like = |key: &str| made_own.is_none_or(|own| own[key] == there[key]);
            like("actuators") && like("scale") && (there["without"].is_null() || like("without"))
        };
        if made_own.is_some() && !library.logged("own").is_some_and(same) {
            changed.extend(own.filter(|point| measured(point)));
        }
        if !changed.is_empty() {
            library.forget(&changed)?;
        }
        Ok(())
    }

    /// Recordings of points that can be read; those of points that are already measured are not read again.
    fn sound(&mut self, present: &[Wanted], library: &Library, faults: &mut Vec<Fault>) -> Vec<Wanted> {
        let known: Vec<String> = faults.iter().map(|fault| fault.file.clone()).collect();
        let mut sound = Vec::new();
        for one in present.iter().filter(|one| one.at.is_some() && !known.contains(&one.file)) {
            let missing = library.state(one.number) == Some(PointState::Missing);
            match missing.then(|| self.takes.take(one)).transpose() {
                Ok(_) => sound.push(one.clone()),
                Err(fault) => faults.push(fault),
            }
        }
        sound
    }

    /// Returns an error for faults of the wiring, or records them as doubts in the library if the request
    /// accepts them.
    fn wires(&self, library: &mut Library, wiring: &WiringResult) -> Result<(), TaskError> {
        let refused = !wiring.faults.is_empty() && !self.campaign.ask.any_wiring;
        wires::tell(&self.campaign, &wiring.notes, if refused { &[] } else { &wiring.faults });
        if refused {
            return Err(TaskError::Work(format!(
                "wiring: {} (mend it and record again; name channels as they were recorded with `tape_inputs`, or turn a reversed one with \
                 `input_scales` NAME=-1; or go on with `any_wiring`)",
                wiring.faults.join("; ")
            )));
        }
        let doubts = wiring.faults.iter().map(|fault| Doubt::of(WIRING, fault)).collect();
        Ok(library.set_doubts(WIRING, doubts)?)
    }
}

/// What was measured, or the reason why the recording cannot be used; an error that is not due to a recording is returned as such.
pub fn heard<T>(found: Result<T, CalibrateError>) -> Result<Result<T, String>, TaskError> {
    match found {
        Ok(channels) => Ok(Ok(channels)),
        Err(error @ (CalibrateError::Recording { .. } | CalibrateError::Dsp(_))) => {
            Ok(Err(error.to_string()))
        }
        Err(error) => Err(error.into()),
    }
}

/// State of the evaluation of recordings into a library.
struct Work<'b, 'a> {
    calibration: &'b TapeCalibration<'a>,
    rig: TapeRig,
    /// The data from which each point is computed, by its number.
    made: BTreeMap<usize, Value>,
    /// The data from which the points at the actuators are computed.
    made_own: Option<Value>,
    /// Recordings that are used.
    all: Vec<Wanted>,
    faults: Vec<Fault>,
    /// Responses at the sensors, with which the recordings of points are compared.
    known: Option<Vec<Channel>>,
    start: Instant,
}

impl Work<'_, '_> {
    fn fill(
        &mut self,
        library: Library,
        wiring: &WiringResult,
    ) -> Result<(LibraryFiller, Report), TaskError> {
        let calibration = self.calibration;
        let known = &calibration.campaign;
        let (last, centre) = (known.places.points.len(), middle(known.surface));
        let dead = wiring.dead.clone();
        let mut filler = LibraryFiller::new(library, known.places.probed, known.surface, &known.scales, dead);
        filler.deaf.clone_from(&wiring.deaf);
        let unheard: Vec<usize> = wiring.dead.iter().chain(&wiring.deaf).copied().collect();
        let first = self.session(&MeasureOptions { without: unheard, ..known.settings.clone() })?;
        let latency = first.find_latency(&mut self.rig, last, centre, known.model)?;
        let settings =
            MeasureOptions { latency: latency.map_or(0.0, |found| found[0]), ..known.settings.clone() };
        self.keep_own(&settings, &mut filler, wiring)?;
        self.known = filler.heard()?;
        let before = filler.missing().len();
        self.keep_points(&settings, &mut filler)?;
        finish(known, &mut filler, latency)?;
        let (measured, taken) = (before - filler.missing().len(), self.start.elapsed());
        if measured > 0 {
            log_run(known, &mut filler.library, measured, taken.as_secs_f64())?;
        }
        let seconds = self.session(&settings)?.seconds();
        let report = self.report(&filler, latency, seconds, taken)?;
        Ok((filler, report))
    }

    fn report(
        &self,
        filler: &LibraryFiller,
        latency: Option<[f64; 2]>,
        seconds: f64,
        taken: Duration,
    ) -> Result<Report, TaskError> {
        Report::of(&filler.library, &self.calibration.campaign.places, latency, None, seconds, taken)
    }

    fn session(&self, settings: &MeasureOptions) -> Result<Session, TaskError> {
        let takes = &self.calibration.takes;
        Ok(Session::new(self.calibration.campaign.surface, takes.layout(), takes.wires.clone(), settings)?)
    }

    /// A session that compares the sensors' signals in each recording with those in the recording of the
    /// actuators.
    fn following(&self, settings: &MeasureOptions) -> Result<Session, TaskError> {
        let mut session = self.session(settings)?;
        if let Some(known) = &self.known {
            session.set_reference(known)?;
        }
        Ok(session)
    }

    /// Number of recordings of a point that are used; the number after the last point stands for the
    /// actuators.
    fn count(&self, number: usize) -> usize {
        self.all.iter().filter(|one| one.number == number).count()
    }

    /// Measures the responses between actuators, and stores them as the library's last points unless they
    /// are bad.
    fn keep_own(
        &mut self,
        settings: &MeasureOptions,
        filler: &mut LibraryFiller,
        wiring: &WiringResult,
    ) -> Result<(), TaskError> {
        let calibration = self.calibration;
        let known = &calibration.campaign;
        let (last, centre) = (known.places.points.len(), middle(known.surface));
        let missing = filler.library.in_state(PointState::Missing);
        if !missing.iter().any(|point| *point >= known.places.probed) {
            return Ok(());
        }
        let repeats = self.count(last).max(1);
        let session = self.session(&MeasureOptions { repeats, ..settings.clone() })?;
        let files: Vec<&str> =
            self.all.iter().filter(|one| one.number == last).map(|one| one.file.as_str()).collect();
        let sensors = match heard(session.measure(&mut self.rig, last, centre, 0, Listen::Sensors))? {
            Ok(sensors) => sensors,
            Err(why) => {
                self.faults.push(bad(&files.join(", "), &why));
                return Ok(());
            }
        };
        let names = known.surface.actuators.iter().map(|actuator| &actuator.name);
        let said = |(actuator, (name, channel)): (usize, (&String, &Channel))| {
            let why = session.fault(channel).filter(|_| !wiring.deaf.contains(&actuator))?;
            Some(bad(&files.join(", "), &format!("sensor of `{name}`, {why}")))
        };
        let faults: Vec<Fault> = names.zip(&sensors).enumerate().filter_map(said).collect();
        if !faults.is_empty() && !known.ask.any_wiring {
            self.faults.extend(faults);
            return Ok(());
        }
        for (point, channel) in (known.places.probed..).zip(&sensors) {
            filler.keep(point, channel, session.fault(channel).as_deref())?;
        }
        filler.library.log("own", self.made_own.clone().unwrap_or(Value::Null))?;
        filler.reciprocity(&sensors)
    }

    /// Measures and stores the points that have recordings; a point with fewer recordings than requested is
    /// averaged over those that exist.
    fn keep_points(
        &mut self,
        settings: &MeasureOptions,
        filler: &mut LibraryFiller,
    ) -> Result<(), TaskError> {
        let calibration = self.calibration;
        let known = &calibration.campaign;
        let missing = filler.missing();
        let there: Vec<usize> =
            self.calibration.good.iter().copied().filter(|n| missing.contains(n)).collect();
        known.with_progress(|progress| progress.stage("points"));
        let keep_bad = known.ask.any_wiring;
        let mut sink = TapeLibraryFiller::new(filler, self.made.clone());
        let mut failed = Vec::new();
        let mut sessions: BTreeMap<usize, Session> = BTreeMap::new();
        for (done, number) in there.iter().copied().enumerate() {
            let repeats = self.count(number);
            if let Entry::Vacant(entry) = sessions.entry(repeats) {
                entry.insert(self.following(&MeasureOptions { repeats, ..settings.clone() })?);
            }
            let session = &sessions[&repeats];
            let at = known.places.points[number];
            let channel = heard(session.measure(&mut self.rig, number, at, 0, Listen::Probe))?;
            let channel = channel.map(|channels| channels.into_iter().next());
            let fault = match &channel {
                Ok(channel) => channel.as_ref().and_then(|channel| session.fault(channel)),
                Err(why) => Some(why.clone()),
            };
            match channel {
                Ok(Some(channel)) if fault.is_none() || keep_bad => {
                    sink.keep(number, &channel, fault.as_deref())?;
                }
                _ => failed.extend(fault.map(|why| (number, why))),
            }
            known.with_progress(|progress| progress.done((done + 1) as f64 / there.len() as f64));
            if known.go_on().is_err() {
                break;
            }
        }
        // What was kept until now stays, and is not measured again.
        sink.log()?;
        known.go_on()?;
        for (number, why) in failed {
            self.name(settings, number, &why)?;
        }
        Ok(())
    }

    /// Adds a fault that names the recording of a point that is bad by itself, or else all its recordings.
    fn name(&mut self, settings: &MeasureOptions, number: usize, why: &str) -> Result<(), TaskError> {
        let files: Vec<String> =
            self.all.iter().filter(|one| one.number == number).map(|one| one.file.clone()).collect();
        let at = self.calibration.campaign.places.points[number];
        let mut named = Vec::new();
        if files.len() > 1 {
            let alone = self.following(&MeasureOptions { repeats: 1, ..settings.clone() })?;
            for (take, file) in files.iter().enumerate() {
                let found = heard(alone.measure(&mut self.rig, number, at, take as u64, Listen::Probe))?;
                let fault = match found {
                    Ok(found) => found.first().and_then(|channel| alone.fault(channel)),
                    Err(why) => Some(why),
                };
                named.extend(fault.map(|why| bad(file, &why)));
            }
        }
        if named.is_empty() {
            named.push(bad(&files.join(", "), why));
        }
        self.faults.extend(named);
        Ok(())
    }
}
