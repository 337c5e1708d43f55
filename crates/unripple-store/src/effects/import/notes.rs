//! The events that an import has read so far, and the score that they make.

use crate::StoreError;
use unripple_effects::{Envelope, Event, Score, Sound, Start, limits};

/// Largest number of points of all envelopes of an import together. Past it the file is refused, which bounds memory.
const MOST_POINTS: usize = 1 << 16;

/// The events read so far.
pub(super) struct Notes<'f> {
    file: &'f str,
    events: Vec<Event>,
    points: usize,
}

impl<'f> Notes<'f> {
    /// No events yet; `file` names the file in messages.
    pub(super) fn new(file: &'f str) -> Self {
        Self { file, events: Vec::new(), points: 0 }
    }

    fn put(&mut self, at: f64, gain: f64, sound: Sound) -> Result<(), StoreError> {
        if self.events.len() >= limits::MOST_EVENTS {
            let expected = format!("at most {} events", limits::MOST_EVENTS);
            return Err(StoreError::content(self.file, expected, "more"));
        }
        self.events.push(Event { at, gain, place: None, sound });
        Ok(())
    }

    pub(super) fn pulse(&mut self, at: f64, gain: f64) -> Result<(), StoreError> {
        if gain > 0.0 { self.put(at, gain, Sound::Pulse) } else { Ok(()) }
    }

    /// A waveform from its points in s, 0 to 1 and Hz; nothing if it is silent throughout.
    pub(super) fn wave(
        &mut self,
        at: f64,
        amplitude: Vec<(f64, f64)>,
        frequency: Vec<(f64, f64)>,
    ) -> Result<(), StoreError> {
        self.points += amplitude.len() + frequency.len();
        if self.points > MOST_POINTS {
            let expected = format!("at most {MOST_POINTS} points of envelopes");
            return Err(StoreError::content(self.file, expected, "more"));
        }
        if amplitude.iter().all(|(_, a)| *a == 0.0) {
            return Ok(());
        }
        let envelope = Envelope::new(amplitude, frequency);
        let envelope =
            envelope.map_err(|e| StoreError::content(self.file, "a legal envelope", e.to_string()))?;
        self.put(at, 1.0, Sound::Wave(envelope))
    }

    pub(super) fn score(self) -> Result<Score, StoreError> {
        if self.events.is_empty() {
            return Err(StoreError::content(self.file, "something to feel", "an empty or silent file"));
        }
        let sounding: f64 = self.events.iter().map(|event| event.sound.duration()).sum();
        if sounding > limits::LONGEST {
            let expected = format!("waveforms of at most {} s together", limits::LONGEST);
            return Err(StoreError::content(self.file, expected, format!("{sounding:.1} s")));
        }
        Ok(Score { start: Start::Touch, period: None, events: self.events })
    }
}
