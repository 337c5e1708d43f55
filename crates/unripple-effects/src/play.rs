//! One effect under one finger: the finger's position and velocity, and the cues that the effect gives.

use crate::{Act, Cue, Level, Wave, limits};
use std::sync::Arc;
use unripple_core::{Outline, Point};

/// The state of a finger at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    /// Time, in s of the clock that times the touches.
    pub time: f64,
    /// Position, in m.
    pub at: Point,
    /// Pressing force, in N, where it is known.
    pub force: Option<f64>,
    /// Smoothed velocity, in m/s.
    pub velocity: Point,
}

impl Moment {
    /// The finger's speed, in m/s, that is assumed at a later time (s) if no touch event has arrived since:
    /// the last one for at most [`limits::HOLD`], then 0.
    pub fn speed_at(&self, time: f64) -> f64 {
        if time > self.time + limits::HOLD { 0.0 } else { self.velocity.x.hypot(self.velocity.y) }
    }
}

/// A running effect: under one contact of one finger, or without a finger.
pub(crate) trait Play: Send {
    /// The finger has entered the region: put down in it (`touched`), or slid into it.
    fn enter(&mut self, _now: &Moment, _touched: bool, _out: &mut Out) {}

    /// The finger moved within the region.
    fn step(&mut self, _from: &Moment, _to: &Moment, _out: &mut Out) {}

    /// The finger moved anywhere on the sheet.
    fn pass(&mut self, _from: &Moment, _to: &Moment, _out: &mut Out) {}

    /// The finger is no longer in the region.
    fn leave(&mut self, _now: &Moment, _out: &mut Out) {}

    /// Adds all timed cues that are due up to and including `until` (s).
    fn due(&mut self, _until: f64, _out: &mut Out) {}

    /// Whether an effect that runs without a finger gives no more cues after a time (s).
    fn is_done(&self, _now: f64) -> bool {
        true
    }
}

/// Makes the running effect for a contact, given the contact's number.
pub(crate) type Maker = Box<dyn Fn(u64) -> Box<dyn Play> + Send>;

/// The number of cues that one call may still add.
pub(crate) struct Budget {
    /// Cues that may still be added.
    pub left: usize,
    /// Number of cues dropped so far because no more could be added.
    pub dropped: u64,
}

/// The output of a running effect.
pub(crate) struct Out<'o> {
    /// The list to which cues are added.
    pub cues: &'o mut Vec<Cue>,
    /// How many cues may still be added.
    pub budget: &'o mut Budget,
    /// The sheet: pulses outside it are not cued.
    pub outline: &'o Outline,
    /// Number of the voice of part 0. Its lowest eight bits are zero; for any other part they hold the
    /// part's number.
    pub voice: u64,
    /// Level of the effect at a gain of 1.
    pub level: Level,
}

impl Out<'_> {
    /// Adds a cue for an act of the effect's part `part`, due at `at` (s). When the budget of cues is used
    /// up, any act except a stop is dropped and counted.
    pub fn push(&mut self, part: u8, at: f64, act: Act) {
        if !matches!(act, Act::Stop { .. }) {
            if self.budget.left == 0 {
                self.budget.dropped += 1;
                return;
            }
            self.budget.left -= 1;
        }
        self.cues.push(Cue { voice: self.voice | u64::from(part), at, act });
    }

    /// Whether the budget is used up, so that further cues are dropped and counted.
    pub fn is_full(&self) -> bool {
        self.budget.left == 0
    }

    /// Adds a cue for a pulse at a time (s) and a place (m), if the place is on the sheet and the gain (a
    /// factor on the effect's level) is positive.
    pub fn pulse(&mut self, at: f64, place: Point, gain: f64) {
        if gain > 0.0 && self.outline.contains(place) {
            self.push(0, at, Act::Pulse { place, gain: self.level.scaled(gain) });
        }
    }

    /// Adds a cue that starts a waveform in part `part` of the effect at a time (s) and a place (m).
    pub fn wave(&mut self, part: u8, at: f64, place: Point, sound: Sounding) {
        let gain = self.level.scaled(sound.gain);
        let Sounding { wave, looped, fade, .. } = sound;
        self.push(part, at, Act::Wave { place, wave, gain, looped, fade });
    }

    /// Adds a cue for one pulse, at a time (s), that is focused on all of the points (m).
    pub fn shape(&mut self, at: f64, points: Arc<[Point]>) {
        self.push(0, at, Act::Shape { points, gain: self.level });
    }

    /// Adds a cue that stops part `part` of the effect at a time (s), with a fade-out of duration `fade`
    /// (s).
    pub fn stop(&mut self, part: u8, at: f64, fade: f64) {
        self.push(part, at, Act::Stop { fade });
    }
}

/// A waveform to be started.
pub(crate) struct Sounding {
    /// The samples, with a full scale of 1.
    pub wave: Wave,
    /// Factor on the effect's level, 0 to 1.
    pub gain: f64,
    /// Whether the waveform repeats until it is stopped.
    pub looped: bool,
    /// Duration of the fade-in, in s.
    pub fade: f64,
}

/// A sequence of periodic instants, given one by one as they fall due.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beat {
    start: f64,
    period: f64,
    index: u64,
}

impl Beat {
    /// Instants from `start` (s) on, one every `period` (s).
    pub fn new(start: f64, period: f64) -> Self {
        Self { start, period, index: 0 }
    }

    /// The number and time (s) of the next instant, if that is not later than `until` (s). Instants overdue
    /// by more than [`limits::LATEST`] are skipped.
    pub fn next(&mut self, until: f64) -> Option<(u64, f64)> {
        let late = ((until - limits::LATEST - self.start) / self.period).ceil();
        // A negative or huge count saturates.
        self.index = self.index.max(late as u64);
        let at = self.start + self.index as f64 * self.period;
        let index = self.index;
        (at <= until).then(|| {
            self.index += 1;
            (index, at)
        })
    }
}
