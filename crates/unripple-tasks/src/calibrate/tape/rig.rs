//! A rig that plays back recordings, and storage of points with a record of the files that they were computed from.

use super::fault::Fault;
use super::planned::Wanted;
use super::takes::Takes;
use crate::TaskError;
use crate::calibrate::filler::LibraryFiller;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{Device, Point};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Rig, Sink};
use unripple_devices::{DevicesError, Tape};

/// Rig that plays back the recordings of each point.
pub struct TapeRig {
    takes: Takes,
    /// The recordings that exist.
    there: Vec<Wanted>,
    tape: Tape,
}

impl TapeRig {
    /// A rig that plays back the existing recordings `there`, the repeats of a point in turn.
    pub fn new(takes: Takes, there: Vec<Wanted>) -> Result<Self, DevicesError> {
        let tape = Tape::recorder(takes.layout().clone())?;
        Ok(Self { takes, there, tape })
    }
}

impl Rig for TapeRig {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.tape
    }

    /// Each attempt plays the next recording of the point; after the last, the first follows.
    fn ready(&mut self, number: usize, _at: Point, attempt: u64) -> Result<(), CalibrateError> {
        let failed = |why: String| CalibrateError::Rig { number, why };
        let own: Vec<&Wanted> = self.there.iter().filter(|one| one.number == number).collect();
        let wanted = own.get(attempt as usize % own.len().max(1));
        let wanted = wanted.ok_or_else(|| failed("there is no recording of it".into()))?;
        let lines = self.takes.take(wanted).map_err(|fault| failed(fault.to_string()))?;
        self.tape = Tape::player(self.takes.layout().clone(), lines).map_err(|e| failed(e.to_string()))?;
        Ok(())
    }

    fn tap(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        Err(CalibrateError::Rig { number, why: "a recording cannot be tapped".into() })
    }
}

/// Number of points whose log entries are written at once: the log is one file, and writing it for each
/// point takes longer the more there are.
const AT_ONCE: usize = 32;

/// Stores points in a library, and records in its log what each was computed from: recordings, scales and
/// options.
pub struct TapeLibraryFiller<'a> {
    filler: &'a mut LibraryFiller,
    /// What each point is computed from, by the points' numbers.
    made: BTreeMap<usize, Value>,
    /// Log entries that are still to be written, by the points' numbers.
    pending: BTreeMap<usize, Value>,
}

impl<'a> TapeLibraryFiller<'a> {
    /// Storage for points in the library of `filler`; `made` contains, by the points' numbers, what each
    /// point is computed from.
    pub fn new(filler: &'a mut LibraryFiller, made: BTreeMap<usize, Value>) -> Self {
        Self { filler, made, pending: BTreeMap::new() }
    }

    /// Stores the responses of point `number`, and notes what they were computed from for the log; `fault`
    /// marks them as bad.
    pub fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), TaskError> {
        self.filler.keep(number, channel, fault)?;
        // Responses first: a point whose log was not written is measured again.
        let made = self.made.get(&number).cloned().unwrap_or(Value::Null);
        self.pending.insert(number, json!({ "made": made }));
        if self.pending.len() < AT_ONCE { Ok(()) } else { self.log() }
    }

    /// Writes the pending notes on what points were computed from to the library's log.
    pub fn log(&mut self) -> Result<(), TaskError> {
        let pending = std::mem::take(&mut self.pending);
        if pending.is_empty() { Ok(()) } else { Ok(self.filler.library.log_points(pending)?) }
    }
}

/// The fault of a recording from which bad responses were computed.
pub fn bad(file: &str, why: &str) -> Fault {
    let mend = "look at the probe and the actuators, and record again (or keep it as bad with `any_wiring`)";
    Fault::new(file, why, mend)
}
