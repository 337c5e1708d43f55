//! Score: pulses and waveforms at given times, started by a touch, at the beginning, or by name.

use crate::error::{counted, place, within};
use crate::play::{Maker, Moment, Out, Play, Sounding};
use crate::{Act, EffectsError, Envelope, Wave, limits};
use std::sync::Arc;
use unripple_core::Point;

/// Duration of the fade-out of a score's waveforms when the score is stopped, in s: short, but without a click.
/// With twice this value, they last another 0.01 s.
const FADE: f64 = 0.01;
/// How long a score is kept after its last event, in s, so that events cued that far ahead can still be stopped. With twice this value,
/// scores that are over are kept a second longer.
const AHEAD: f64 = 1.0;
/// Number of waveforms of a score that can sound at once: parts 1 to 255 of its voice, part 0 being for pulses. A further
/// waveform replaces the first.
const PARTS: usize = 255;

/// A score: pulses and waveforms at given times.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// What starts the score.
    pub start: Start,
    /// Period after which the score repeats, in s; `None` if it plays once.
    pub period: Option<f64>,
    /// The events, in any order.
    pub events: Vec<Event>,
}

/// What starts a score.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// A finger that enters the region. The score ends when the finger leaves.
    Touch,
    /// The first call of [`Effects::touch`](crate::Effects::touch) or [`Effects::tick`](crate::Effects::tick).
    Zero,
    /// A call of [`Effects::start`](crate::Effects::start) with the name of the effect.
    Name,
}

/// One event of a score.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Time, in s after the start of the score.
    pub at: f64,
    /// Gain of the event, 0 to 1.
    pub gain: f64,
    /// Where the event is played, in m; `None` for the place of the finger, or, in a score without a finger,
    /// for the place at which the score was started.
    pub place: Option<Point>,
    /// What is played: a pulse or a waveform.
    pub sound: Sound,
}

/// What an event of a score plays.
#[derive(Clone, Debug, PartialEq)]
pub enum Sound {
    /// One focused pulse.
    Pulse,
    /// A waveform, played once.
    Wave(Envelope),
}

impl Sound {
    /// Duration, in s; 0 for a pulse.
    pub fn duration(&self) -> f64 {
        match self {
            Self::Pulse => 0.0,
            Self::Wave(envelope) => envelope.duration(),
        }
    }
}

impl Score {
    /// Refuses times, gains and places that are out of range.
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

    /// Total duration of the score's waveforms, in s.
    pub(super) fn sounding(&self) -> f64 {
        self.events.iter().map(|event| event.sound.duration()).sum()
    }

    /// The function that starts it, with waveforms at `rate` samples per second.
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

/// An event with its waveform sampled, ready to be cued.
struct Note {
    at: f64,
    gain: f64,
    place: Option<Point>,
    wave: Option<Wave>,
}

struct Playing {
    notes: Arc<[Note]>,
    period: Option<f64>,
    /// Time (s) at which it started or last repeated, and the place (m) of the finger or of the start.
    on: Option<(f64, Point)>,
    next: usize,
    /// Waveforms being played: the part, the time (s) at which it ends, and whether it moves with the finger.
    sounding: Vec<(u8, f64, bool)>,
}

impl Playing {
    /// Index and time (s) of the next event, if it is due up to `until` (s).
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
            // Events that are overdue by too much are skipped.
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
