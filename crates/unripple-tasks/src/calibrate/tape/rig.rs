//! A rig that plays back recordings, and storage of points with a record of the files that they were computed from.

use super::asked::Wanted;
use super::fault::Fault;
use super::takes::Takes;
use crate::TaskError;
use crate::calibrate::shelf::Shelf;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{Device, Point};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Rig, Sink};
use unripple_devices::{DevicesError, Tape};

/// Rig that plays back the recordings of each point.
pub struct TapeRig {
    takes: Takes,
    /// The recordings that are there.
    there: Vec<Wanted>,
    tape: Tape,
}

impl TapeRig {
    /// Recordings that are there, to be played back in order of point and repeat.
    pub fn new(takes: Takes, there: Vec<Wanted>) -> Result<Self, DevicesError> {
        let tape = Tape::recorder(takes.layout().clone())?;
        Ok(Self { takes, there, tape })
    }
}

impl Rig for TapeRig {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.tape
    }

    /// The recordings of a point come round, one for each attempt.
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

/// Points of which the log is written at once: it is one file, and writing it for each point takes longer the more
/// there are.
const AT_ONCE: usize = 32;

/// Stores points, and in their log what they were computed from: recordings, scales and options.
pub struct TapeShelf<'a> {
    shelf: &'a mut Shelf,
    /// What each point is computed from; the keys are the points' numbers.
    made: BTreeMap<usize, Value>,
    /// What is still to be logged.
    pending: BTreeMap<usize, Value>,
}

impl<'a> TapeShelf<'a> {
    /// Stores points in a library; `made` says what each point is computed from, with the points' numbers as keys.
    pub fn new(shelf: &'a mut Shelf, made: BTreeMap<usize, Value>) -> Self {
        Self { shelf, made, pending: BTreeMap::new() }
    }

    /// Stores the responses of the point of this number, and what they were computed from.
    pub fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), TaskError> {
        self.shelf.keep(number, channel, fault)?;
        // Responses first: a point whose log was not written is measured again.
        let made = self.made.get(&number).cloned().unwrap_or(Value::Null);
        self.pending.insert(number, json!({ "made": made }));
        if self.pending.len() < AT_ONCE { Ok(()) } else { self.log() }
    }

    /// Writes to the log what points were computed from.
    pub fn log(&mut self) -> Result<(), TaskError> {
        let pending = std::mem::take(&mut self.pending);
        if pending.is_empty() { Ok(()) } else { Ok(self.shelf.library.log_points(pending)?) }
    }
}

/// The fault of a recording from which bad responses came.
pub fn bad(file: &str, why: &str) -> Fault {
    let mend = "look at the probe and the actuators, and record again (or keep it as bad with `any_wiring`)";
    Fault::new(file, why, mend)
}
