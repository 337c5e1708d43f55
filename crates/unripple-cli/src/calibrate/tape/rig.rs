//! Recordings in place of a surface, and points in place of a library that keeps only good ones.

use super::plan::Wanted;
use super::takes::{Fault, Takes};
use crate::calibrate::shelf::Shelf;
use unripple::core::{Device, Point};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Channel, Rig, Sink};
use unripple_devices::{DevicesError, Tape};

/// Plays back what was recorded of each point.
pub struct TapeRig {
    takes: Takes,
    wanted: Vec<Wanted>,
    repeats: u64,
    tape: Tape,
}

impl TapeRig {
    pub fn new(takes: Takes, wanted: Vec<Wanted>, repeats: usize) -> Result<Self, DevicesError> {
        let tape = Tape::recorder(takes.layout.clone())?;
        Ok(Self { takes, wanted, repeats: repeats.max(1) as u64, tape })
    }
}

impl Rig for TapeRig {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.tape
    }

    fn ready(&mut self, number: usize, _at: Point, attempt: u64) -> Result<(), CalibrateError> {
        let failed = |why: String| CalibrateError::Rig { number, why };
        let repeat = (attempt % self.repeats) as usize;
        let wanted = self.wanted.iter().find(|one| one.number == number && one.repeat == repeat);
        let wanted = wanted.ok_or_else(|| failed("there is no recording of it in the plan".into()))?;
        let lines = self.takes.take(wanted).map_err(|fault| failed(fault.to_string()))?;
        self.tape = Tape::player(self.takes.layout.clone(), lines).map_err(|e| failed(e.to_string()))?;
        Ok(())
    }

    fn tap(&mut self, number: usize, _at: Point, _attempt: u64) -> Result<(), CalibrateError> {
        Err(CalibrateError::Rig { number, why: "a recording cannot be tapped".into() })
    }
}

/// Keeps the points whose recordings are there. One that turns out bad is not kept, so that it can be recorded again, unless
/// `keep_bad`.
pub struct TapeShelf<'a> {
    pub shelf: &'a mut Shelf,
    /// Points whose recordings are there and can be read.
    pub there: Vec<usize>,
    pub wanted: &'a [Wanted],
    pub keep_bad: bool,
    pub faults: Vec<Fault>,
}

impl Sink for TapeShelf<'_> {
    fn missing(&self) -> Vec<usize> {
        self.shelf.missing().into_iter().filter(|point| self.there.contains(point)).collect()
    }

    fn keep(&mut self, number: usize, channel: &Channel, fault: Option<&str>) -> Result<(), CalibrateError> {
        match (fault, self.wanted.iter().find(|one| one.number == number)) {
            (Some(why), Some(one)) if !self.keep_bad => {
                self.faults.push(bad(&one.file, why));
                Ok(())
            }
            _ => self.shelf.keep(number, channel, fault),
        }
    }
}

/// What to say of a recording from which bad responses came.
pub fn bad(file: &str, why: &str) -> Fault {
    let mend = "look at the probe and the actuators, and record again (or keep it as bad with --any-wiring)";
    Fault { file: file.into(), why: why.into(), mend: mend.into() }
}
