//! Calibration by recordings of taps, or of a hammer's blows with their force, made elsewhere: nothing is played.

use super::channels::{few, layout};
use super::fault::Fault;
use super::library::{library_of, outdated};
use super::marks::Marks;
use super::measure::heard;
use super::planned::{Wanted, listed};
use super::read::{Needed, Reader};
use super::rig::TapeLibraryFiller;
use super::strikes;
use crate::TaskError;
use crate::calibrate::before;
use crate::calibrate::campaign::Campaign;
use crate::calibrate::filler::LibraryFiller;
use crate::calibrate::finish::{begin, finish, log_run};
use crate::calibrate::outcome::doubted;
use crate::calibrate::report::Report as LibraryReport;
use crate::calibrate::{By, Report, figure, hammer, levels, taps};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use unripple::core::Layout;
use unripple::core::clock::Instant;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, HammerSession, MeasureOptions, Sink, TapSession, Wires};
use unripple_calibrate::signals::Band;
use unripple_store::Library;

/// What to do about a recording of which no response can be made.
const MEND: &str =
    "look at the hammer and the sensors, and record it again (or keep it as bad with `any_wiring`)";

/// How responses are made of recordings.
enum Way {
    Hammer(Box<HammerSession>),
    Tap(Box<TapSession>),
}

/// A calibration by recordings of taps or blows.
struct Recorded<'a> {
    campaign: Campaign<'a>,
    folder: &'a Path,
    wanted: Vec<Wanted>,
    reader: Reader,
    wires: Wires,
    faults: Vec<Fault>,
    /// Seconds of recordings that were read, and their number.
    read: (f64, usize),
}

/// Computes as much of the library as the recordings in a folder allow.
pub(super) fn run<'a>(mut campaign: Campaign<'a>, folder: &'a Path) -> Result<Report, TaskError> {
    let (ask, surface) = (campaign.ask, campaign.surface);
    before::apply(ask, surface, &mut campaign.settings)?;
    campaign.settings = MeasureOptions { retries: 0, ..campaign.settings };
    let layout = layout(ask, surface, campaign.scales.full_scale(surface))?;
    let wires = Wires::by_name(&campaign.model.ports, &layout, &ask.wires)?;
    let (places, wanted) = strikes::wanted(ask, surface, folder)?;
    few(places.probed, 1)?;
    campaign.places = places;
    let [from, to] = campaign.settings.swept(surface);
    let reader = Reader { layout, band: Band::within(from, to), resample: ask.resample };
    let mut recorded =
        Recorded { campaign, folder, wanted, reader, wires, faults: Vec::new(), read: (0.0, 0) };
    if ask.check_levels {
        let files: Vec<_> = recorded.present().iter().map(|one| (folder.join(&one.file), false)).collect();
        return Report::of_levels(&levels::look(&files, &recorded.reader.layout.inputs)?);
    }
    let start = Instant::now();
    let filler = if recorded.present().is_empty() { None } else { Some(recorded.fill(start)?) };
    let seconds = recorded.read.0 / recorded.read.1.max(1) as f64;
    let report = match &filler {
        None => None,
        Some(filler) => {
            let (places, taken) = (&recorded.campaign.places, start.elapsed());
            Some(LibraryReport::of(&filler.library, places, None, None, seconds, taken)?)
        }
    };
    let drawn = match &filler {
        Some(filler) => figure::write(&mut recorded.campaign, &filler.library),
        None => Ok(()),
    };
    recorded.answer(report.as_ref(), filler.as_ref().map(|filler| &filler.library), drawn)
}

impl Recorded<'_> {
    /// The recordings that are there.
    fn present(&self) -> Vec<Wanted> {
        self.wanted.iter().filter(|one| self.folder.join(&one.file).is_file()).cloned().collect()
    }

    /// Fills the library with the responses that can be made of the recordings.
    fn fill(&mut self, start: Instant) -> Result<LibraryFiller, TaskError> {
        let present = self.present();
        let output = &self.campaign.ask.output;
        let there = Library::is_at(output).then(|| Library::open(output)).transpose()?;
        let marks = Marks::of(self.folder, present.iter(), there.as_ref());
        drop(there);
        self.faults = marks.copies(&[]);
        let copies: Vec<String> = self.faults.iter().map(|fault| fault.file.clone()).collect();
        let sound: Vec<Wanted> = present.into_iter().filter(|one| !copies.contains(&one.file)).collect();
        let mut library = library_of(&self.campaign)?;
        let made = self.made(&sound, &marks);
        let changed = outdated(&library, &made);
        if !changed.is_empty() {
            library.forget(&changed)?;
        }
        marks.keep(&mut library)?;
        begin(&self.campaign, &mut library)?;
        let known = &self.campaign;
        let without = known.settings.without.clone();
        let filler = LibraryFiller::new(library, known.places.probed, known.surface, &known.scales, without);
        let mut filler = filler.by_taps();
        let before = filler.missing().len();
        self.points(&mut filler, &sound, made)?;
        finish(&self.campaign, &mut filler, None)?;
        let measured = before - filler.missing().len();
        if measured > 0 {
            log_run(&self.campaign, &mut filler.library, measured, start.elapsed().as_secs_f64())?;
        }
        Ok(filler)
    }

    /// What each point is computed from: its recordings, scales, and the actuators that are left out.
    fn made(&self, sound: &[Wanted], marks: &Marks) -> BTreeMap<usize, Value> {
        let (scale, without) = (self.campaign.scales.told(), &self.campaign.ask.without);
        let numbers: BTreeSet<usize> = sound.iter().map(|one| one.number).collect();
        let made = |number: usize| {
            let takes = marks.told(sound.iter().filter(|one| one.number == number));
            (number, json!({ "takes": takes, "scale": scale, "without": without }))
        };
        numbers.into_iter().map(made).collect()
    }

    /// How responses are made of recordings.
    fn way(&self, filler: &mut LibraryFiller) -> Result<Way, TaskError> {
        let known = &self.campaign;
        let (layout, wires): (&Layout, &Wires) = (&self.reader.layout, &self.wires);
        if known.ask.by != By::Hammer {
            let session = taps::session(known, filler, layout, wires, &known.settings)?;
            return Ok(Way::Tap(Box::new(session)));
        }
        Ok(Way::Hammer(Box::new(hammer::session(known, filler, layout, wires, &known.settings)?)))
    }

    /// Computes and stores the points that have recordings.
    fn points(
        &mut self,
        filler: &mut LibraryFiller,
        sound: &[Wanted],
        made: BTreeMap<usize, Value>,
    ) -> Result<(), TaskError> {
        let missing = filler.missing();
        let way = self.way(filler)?;
        let there: Vec<usize> = made.keys().copied().filter(|number| missing.contains(number)).collect();
        self.campaign.with_progress(|progress| progress.stage("points"));
        let mut sink = TapeLibraryFiller::new(filler, made);
        for (done, number) in there.iter().copied().enumerate() {
            let files: Vec<&Wanted> = sound.iter().filter(|one| one.number == number).collect();
            let names: Vec<&str> = files.iter().map(|one| one.file.as_str()).collect();
            let lines: Vec<Vec<Vec<f64>>> = files.iter().filter_map(|one| self.lines(one)).collect();
            if !lines.is_empty() {
                let at = self.campaign.places.points[number];
                let found = match &way {
                    Way::Hammer(session) => blown(session, &lines),
                    Way::Tap(session) => {
                        session.responses(&lines, at).map(|channel| (session.fault(&channel), channel))
                    }
                };
                let why = match heard(found)? {
                    Ok((fault, channel)) if fault.is_none() || self.campaign.ask.any_wiring => {
                        sink.keep(number, &channel, fault.as_deref())?;
                        None
                    }
                    Ok((fault, _)) => fault,
                    Err(why) => Some(why),
                };
                self.faults.extend(why.map(|why| Fault::new(&names.join(", "), why, MEND)));
            }
            self.campaign.with_progress(|progress| progress.done((done + 1) as f64 / there.len() as f64));
            if self.campaign.go_on().is_err() {
                break;
            }
        }
        // What was kept until now stays, and is not computed again.
        sink.log()?;
        self.campaign.go_on()
    }

    /// The sensors' signals in a recording and, with a hammer, the force last; `None` of a recording that cannot be read, which is a fault.
    fn lines(&mut self, one: &Wanted) -> Option<Vec<Vec<f64>>> {
        let sensors = &self.wires.sensors;
        // A clipped blow is refused by itself, whatever else its recording holds.
        let any = if self.campaign.ask.by == By::Hammer { &[][..] } else { &sensors[..] };
        match self.reader.read(self.folder, &one.file, &Needed { all: &[], any }) {
            Err(fault) => {
                self.faults.push(fault);
                None
            }
            Ok(channels) => {
                let seconds =
                    channels.first().map_or(0.0, |line| line.len() as f64 / self.reader.layout.rate);
                self.read = (self.read.0 + seconds, self.read.1 + 1);
                let force = self.wires.force.filter(|_| self.campaign.ask.by == By::Hammer);
                Some(sensors.iter().chain(&force).map(|input| channels[*input].clone()).collect())
            }
        }
    }

    /// The report: what was measured, what is still to be recorded, and what is wrong.
    fn answer(
        &self,
        report: Option<&LibraryReport>,
        library: Option<&Library>,
        drawn: Result<(), TaskError>,
    ) -> Result<Report, TaskError> {
        let missing: Vec<&Wanted> =
            self.wanted.iter().filter(|one| !self.folder.join(&one.file).is_file()).collect();
        let mut found = match report {
            Some(report) => serde_json::to_value(report).map_err(TaskError::work)?,
            None => json!({ "notes": [] }),
        };
        if let Some(found) = found.as_object_mut() {
            let tape = json!({
                "folder": self.folder.display().to_string(),
                "missing": missing.iter().map(|one| &one.file).collect::<Vec<_>>(),
                "wrong": self.faults.iter().map(Fault::json).collect::<Vec<_>>(),
            });
            found.insert("tape".into(), tape);
        }
        let text = report.map_or_else(String::new, LibraryReport::text) + &self.wanting(&missing);
        let faults: Vec<String> = self.faults.iter().map(|fault| format!("  {fault}")).collect();
        let faults = (!faults.is_empty()).then(|| format!("cannot be used:\n{}", faults.join("\n")));
        let failures: Vec<String> = faults.into_iter().chain(library.and_then(doubted)).collect();
        let failure = (!failures.is_empty()).then(|| failures.join("\n"));
        Ok(Report::of_tape(found, text, failure.or(drawn.err().map(|error| error.to_string()))))
    }

    /// Text on what is still to be recorded.
    fn wanting(&self, missing: &[&Wanted]) -> String {
        if missing.is_empty() {
            return String::new();
        }
        let what = if self.campaign.ask.by == By::Hammer { "a blow" } else { "a tap" };
        let layout = &self.reader.layout;
        let text = format!(
            "still to be recorded in {}, as WAV at {} Hz with the channels {}:\n",
            self.folder.display(),
            layout.rate,
            layout.inputs.join(", ")
        );
        let at = |one: &Wanted| one.at.map_or_else(|| what.to_owned(), |at| format!("{what} at {at}"));
        text + &listed(missing, at, "")
    }
}

/// Responses from all blows in the recordings of a point, and the reason why they are bad, if they are.
fn blown(
    session: &HammerSession,
    recordings: &[Vec<Vec<f64>>],
) -> Result<(Option<String>, Channel), CalibrateError> {
    let (mut good, mut refused) = (Vec::new(), Vec::new());
    for heard in recordings {
        for blow in session.blows(heard)? {
            match blow {
                Ok(struck) => good.push(struck),
                Err(fault) => refused.push(fault),
            }
        }
    }
    let channel = session.responses(&good, refused)?;
    Ok((session.fault(&channel), channel))
}
