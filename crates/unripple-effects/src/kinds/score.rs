//! Events over time, started by a touch.

use crate::error::{counted, place, within};
use crate::play::{Maker, Moment, Out, Play, Sounding};
use crate::{Act, EffectsError, Envelope, Wave, limits};
use std::sync::Arc;
use unripple_core::Point;

/// Time over which a waveform of a score falls when the score is stopped, in s: short, and without a click.
/// Doubled, it is heard for as much longer.
const FADE: f64 = 0.01;
/// How far ahead events may be cued and still be stopped, once all of them are, in s. Doubled, scores that
/// are over are kept a second longer.
const AHEAD: f64 = 1.0;
/// Voices of a score that sound at once: parts 1 to 255 of its voice, 0 being the effect's own. The next
/// event takes the first's place.
const PARTS: usize = 255;

/// A score: pulses and waveforms over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// What starts it: a touch, the first touch or tick at all, or its name.
    pub start: Start,
    /// Period after which it starts over, in s; without, it plays once.
    pub period: Option<f64>,
    /// The events, in any order.
    pub events: Vec<Event>,
}

/// What starts a score: a touch, the first touch or tick at all, or its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// A finger that comes into the region. It ends when the finger leaves.
    Touch,
    /// The first touch or tick at all.
    Zero,
    /// [`crate::Effects::start`] with the name of the effect.
    Name,
}

/// One event of a score.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When, in s after the start.
    pub at: f64,
    /// Its own gain, 0 to 1.
    pub gain: f64,
    /// Where; without, at the finger, or where the score was started.
    pub place: Option<Point>,
    /// What it sounds like.
    pub sound: Sound,
}

/// What an event of a score sounds like.
#[derive(Clone, Debug, PartialEq)]
pub enum Sound {
    /// One focused pulse.
    Pulse,
    /// A waveform, played once.
    Wave(Envelope),
}

impl Sound {
    /// How long it lasts, in s; nothing for a pulse.
    pub fn duration(&self) -> f64 {
        match self {
            Self::Pulse => 0.0,
            Self::Wave(envelope) => envelope.duration(),
        }
    }
}

impl Score {
    /// Refuses times, gains and places that are not legal.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        counted("events of a score", self.events.len(), 1, limits::MOST_EVENTS)?;
        for event in &self.events {
            within("time of an event", event.at, limits::TIME)?;
            within("gain of an event", event.gain, limits::SHARE)?;
            event.place.map_or(Ok(()), |at| place("place of an event", at))?;
        }
        let last = self.events.iter().map(|event| event.at).fold(0.0, f64::max);
        let least = limits::PERIOD[0].max(last);
        self.period.map_or(Ok(()), |period| within("period of a score", period, [least, limits::PERIOD[1]]))
    }

    /// Seconds of waveforms that it keeps.
    pub(super) fn sounding(&self) -> f64 {
        self.events.iter().map(|event| event.sound.duration()).sum()
    }

    /// What plays it, waveforms at `rate` samples per second.
    pub(super) fn maker(&self, rate: f64) -> Result<Maker, EffectsError> {
        let note = |event: &Event| {
            let wave = match &event.sound {
                Sound::Pulse => None,
                Sound::Wave(envelope) => Some(envelope.sampled(rate)?),
            };
            Ok(Note { at: event.at, gain: event.gain, place: event.place, wave })
        };
        let mut notes = self.events.iter().map(note).collect::<Result<Vec<Note>, EffectsError>>()?;
        notes.sort_by(|a, b| a.at.total_cmp(&b.at));
        let (notes, period): (Arc<[Note]>, _) = (notes.into(), self.period);
        Ok(Box::new(move |_| {
            Box::new(Playing { notes: notes.clone(), period, on: None, next: 0, sounding: Vec::new() })
        }))
    }
}

/// An event ready to be cued.
struct Note {
    at: f64,
    gain: f64,
    place: Option<Point>,
    wave: Option<Wave>,
}

struct Playing {
    notes: Arc<[Note]>,
    period: Option<f64>,
    /// When it started, or last started over, and where it plays.
    on: Option<(f64, Point)>,
    next: usize,
    /// Waveforms that sound: their part, when they end, and whether they go with the finger.
    sounding: Vec<(u8, f64, bool)>,
}

impl Playing {
    /// The next event due, and when.
    fn next_due(&mut self, until: f64) -> Option<(usize, f64)> {
        if self.next == self.notes.len() {
            let period = self.period?;
            let (start, _) = self.on.as_mut()?;
            // Repetitions that are long past are skipped.
            let missed = ((until - limits::LATEST - *start) / period).floor().max(1.0);
            if *start + missed * period > until {
                return None;
            }
            *start += missed * period;
            self.next = 0;
        }
        let at = self.on?.0 + self.notes[self.next].at;
        (at <= until).then(|| {
            self.next += 1;
            (self.next - 1, at)
        })
    }

    /// Cues one event, a waveform in the next free part.
    fn play(&mut self, index: usize, at: f64, finger: Point, out: &mut Out) {
        let note = &self.notes[index];
        let place = note.place.unwrap_or(finger);
        let Some(wave) = &note.wave else {
            out.pulse(at, place, note.gain);
            return;
        };
        let part = (index % PARTS) as u8 + 1;
        self.sounding.retain(|(sounding, _, _)| *sounding != part);
        if out.outline.contains(place) && note.gain > 0.0 {
            self.sounding.push((part, at + wave.duration(), note.place.is_none()));
            out.wave(
                part,
                at,
                place,
                Sounding { wave: wave.clone(), gain: note.gain, looped: false, fade: 0.0 },
            );
        }
    }
}

impl Play for Playing {
    fn enter(&mut self, now: &Moment, _touched: bool, _out: &mut Out) {
        self.on = Some((now.time, now.at));
        self.next = 0;
    }

    fn step(&mut self, from: &Moment, to: &Moment, out: &mut Out) {
        let Some((_, place)) = &mut self.on else { return };
        *place = to.at;
        if from.at != to.at {
            for (part, _, _) in self.sounding.iter().filter(|(_, end, follows)| *follows && *end > to.time) {
                out.push(*part, to.time, Act::Move { place: to.at });
            }
        }
    }

    fn leave(&mut self, now: &Moment, out: &mut Out) {
        if self.on.take().is_none() {
            return;
        }
        out.stop(0, now.time, 0.0);
        for (part, end, _) in self.sounding.drain(..) {
            if end > now.time {
                out.stop(part, now.time, FADE);
            }
        }
    }

    fn due(&mut self, until: f64, out: &mut Out) {
        let Some((_, place)) = self.on else { return };
        while !out.is_full() {
            let Some((index, at)) = self.next_due(until) else { break };
            // An event overdue by too much is as good as not written.
            if at >= until - limits::LATEST {
                self.play(index, at, place, out);
            }
        }
    }

    fn is_done(&self, now: f64) -> bool {
        let Some((start, _)) = self.on else { return true };
        let is_over = self.period.is_none() && self.next == self.notes.len();
        let last = start + self.notes[self.notes.len() - 1].at;
        let end = self.sounding.iter().map(|(_, end, _)| *end).fold(last, f64::max);
        is_over && now > end + AHEAD
    }
}
