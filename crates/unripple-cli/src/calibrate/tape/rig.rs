//! Recordings in place of a surface, and points in place of a library that keeps only good ones.

use super::asked::Wanted;
use super::fault::Fault;
use super::takes::Takes;
use crate::calibrate::shelf::Shelf;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use unripple::core::{Device, Point};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Rig, Sink};
use unripple_devices::{DevicesError, Tape};

/// Plays back what was recorded of each point.
pub struct TapeRig {
    takes: Takes,
    /// The recordings that are there.
    there: Vec<Wanted>,
    tape: Tape,
}

impl TapeRig {
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

/// Points of which the log is written at once.
const AT_ONCE: usize = 32;

/// Keeps the points whose recordings are there. One that turns out bad is not kept, so that it can be recorded again, unless
/// `keep_bad`.
pub struct TapeShelf<'a> {
    pub shelf: &'a mut Shelf,
    /// Points whose recordings are there and can be read, and what they are made of.
    pub there: BTreeMap<usize, Value>,
    pub keep_bad: bool,
    /// Points that turned out bad, and why.
    pub bad: Vec<(usize, String)>,
    /// What is to be logged of points.
    made: BTreeMap<usize, Value>,
}

impl<'a> TapeShelf<'a> {
    pub fn new(shelf: &'a mut Shelf, there: BTreeMap<usize, Value>, keep_bad: bool) -> Self {
        Self { shelf, there, keep_bad, bad: Vec::new(), made: BTreeMap::new() }
    }

    /// Writes down what points were made of.
    pub fn log(&mut self) -> Result<(), CalibrateError> {
        let made = std::mem::take(&mut self.made);
        let Some(number) = made.keys().next().copied() else { return Ok(()) };
        let kept = self.shelf.library.log_points(made);
        kept.map_err(|error| CalibrateError::Sink { number, why: error.to_string() })
    }
}

impl Sink for TapeShelf<'_> {
    fn missing(&self) -> Vec<usize> {
        self.shelf.missing().into_iter().filter(|point| self.there.contains_key(point)).collect()
    }

    fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), CalibrateError> {
        if let Some(why) = fault.filter(|_| !self.keep_bad) {
            self.bad.push((number, why.to_owned()));
            return Ok(());
        }
        self.shelf.keep(number, channel, fault)?;
        // Responses first: a point whose log was not written is measured again.
        let made = self.there.get(&number).cloned().unwrap_or(Value::Null);
        self.made.insert(number, json!({ "made": made }));
        if self.made.len() < AT_ONCE { Ok(()) } else { self.log() }
    }
}

/// What to say of a recording from which bad responses came.
pub fn bad(file: &str, why: &str) -> Fault {
    let mend = "look at the probe and the actuators, and record again (or keep it as bad with --any-wiring)";
    Fault::new(file, why, mend)
}
