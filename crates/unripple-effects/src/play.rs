//! What an effect does under one finger: where that is, how fast it moves, and the cues that follow.

use crate::{Act, Cue, Level, Wave, limits};
use std::sync::Arc;
use unripple_core::{Outline, Point};

/// A finger at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    /// When, in s of the touches' clock.
    pub time: f64,
    /// Where it is, in m.
    pub at: Point,
    /// How hard it presses, in N, where that is known.
    pub force: Option<f64>,
    /// Smoothed velocity, in m/s.
    pub velocity: Point,
}

impl Moment {
    /// Speed in m/s at a time after this, when nothing was heard since.
    pub fn speed_at(&self, time: f64) -> f64 {
        if time > self.time + limits::HOLD { 0.0 } else { self.velocity.x.hypot(self.velocity.y) }
    }
}

/// One effect under one contact of one finger, or by itself.
pub(crate) trait Play: Send {
    /// The finger is in the region from now on: put down there, or slid into it.
    fn enter(&mut self, _now: &Moment, _touched: bool, _out: &mut Out) {}

    /// The finger moved within the region.
    fn step(&mut self, _from: &Moment, _to: &Moment, _out: &mut Out) {}

    /// The finger moved anywhere on the sheet.
    fn pass(&mut self, _from: &Moment, _to: &Moment, _out: &mut Out) {}

    /// The finger is no longer in the region.
    fn leave(&mut self, _now: &Moment, _out: &mut Out) {}

    /// Everything timed that is due up to and with `until` (s).
    fn due(&mut self, _until: f64, _out: &mut Out) {}

    /// Whether nothing comes of it after a time (s), without a finger.
    fn is_done(&self, _now: f64) -> bool {
        true
    }
}

/// Makes the play of a contact with a number of its own.
pub(crate) type Maker = Box<dyn Fn(u64) -> Box<dyn Play> + Send>;

/// How many cues one call may still add.
pub(crate) struct Budget {
    /// Cues that may still be added.
    pub left: usize,
    /// Cues left out so far.
    pub dropped: u64,
}

/// Where a play puts its cues.
pub(crate) struct Out<'o> {
    /// Where cues go.
    pub cues: &'o mut Vec<Cue>,
    /// How many cues there may still be.
    pub budget: &'o mut Budget,
    /// The sheet, off which nothing is cued.
    pub outline: &'o Outline,
    /// Voice of part 0; the lowest eight bits are free.
    pub voice: u64,
    /// How strong the effect is at a gain of 1.
    pub level: Level,
}

impl Out<'_> {
    /// Adds an act of a part of the voice at a time (s), if there is room.
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

    /// Whether further cues would only be counted.
    pub fn is_full(&self) -> bool {
        self.budget.left == 0
    }

    /// Adds a pulse at a time (s) and a place (m) with a gain (a factor), if the place is on the sheet.
    pub fn pulse(&mut self, at: f64, place: Point, gain: f64) {
        if gain > 0.0 && self.outline.contains(place) {
            self.push(0, at, Act::Pulse { place, gain: self.level.scaled(gain) });
        }
    }

    /// Adds a waveform of a part at a time (s) and a place (m).
    pub fn wave(&mut self, part: u8, at: f64, place: Point, sound: Sounding) {
        let gain = self.level.scaled(sound.gain);
        let Sounding { wave, looped, fade, .. } = sound;
        self.push(part, at, Act::Wave { place, wave, gain, looped, fade });
    }

    /// Adds a shape of points (m) at a time (s).
    pub fn shape(&mut self, at: f64, points: Arc<[Point]>) {
        self.push(0, at, Act::Shape { points, gain: self.level });
    }

    /// Adds the end of a part at a time (s), with a fade (s).
    pub fn stop(&mut self, part: u8, at: f64, fade: f64) {
        self.push(part, at, Act::Stop { fade });
    }
}

/// A waveform about to sound.
pub(crate) struct Sounding {
    /// Its samples, full scale being the level.
    pub wave: Wave,
    /// Factor on the effect's level, 0 to 1.
    pub gain: f64,
    /// Whether it starts over at its end.
    pub looped: bool,
    /// Time over which it rises, in s.
    pub fade: f64,
}

/// Instants a whole number of periods after a start, as they fall due.
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

    /// The next instant (s) due up to `until` (s), with its number. Instants overdue by too much are skipped.
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
