//! Effects imported from files made for phones and controllers.

mod ahap;
mod haptic;
mod hjif;
mod node;

use super::near;
use crate::StoreError;
use crate::file::LARGEST_TEXT;
use node::Node;
use std::path::Path;
use unripple_effects::{Envelope, Event, Score, Sound, Start, limits};

/// Most points of all envelopes of an import together. Past it the file is refused, which bounds memory.
const MOST_POINTS: usize = 1 << 16;

/// Frequencies of the pitches 0 and 1 of formats for phones, in Hz: the range of MPEG's reference encoder for AHAP.
const PITCH: [f64; 2] = [65.0, 300.0];

/// Reads a score of haptic events from the text of a file made for phones and controllers. The format follows from
/// the file's extension: `.haptic` (Lofelt, Meta), `.ahap` (Apple) or `.hjif` (ISO/IEC 23090-31).
///
/// The score starts with a touch and plays at the finger. Short events become focused pulses, whatever their pitch;
/// long ones become waveforms. A pitch from 0 to 1 becomes a frequency from 65 to 300 Hz. Audio events are left out.
///
/// # Errors
/// [`StoreError::Content`], with the place in the file, what was expected and what was found there.
///
/// ```
/// let text = r#"{"version": {"major": 1, "minor": 0, "patch": 0}, "signals": {"continuous": {"envelopes": {
///     "amplitude": [{"time": 0.0, "amplitude": 0.2}, {"time": 0.5, "amplitude": 0.9}]}}}}"#;
/// let score = unripple_store::import_haptic(text, "swell.haptic")?;
/// assert_eq!(score.events.len(), 1);
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn import_haptic(text: &str, file: &str) -> Result<Score, StoreError> {
    if text.len() > LARGEST_TEXT {
        return Err(crate::file::too_large(file, text.len() as u64));
    }
    let ending = Path::new(file).extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let read = match ending.as_str() {
        "haptic" => haptic::read,
        "ahap" => ahap::read,
        "hjif" => hjif::read,
        _ => {
            let found = format!("a name that ends in `{ending}`");
            return Err(StoreError::content(file, "a .haptic, .ahap or .hjif file", found));
        }
    };
    let value = serde_json::from_str(text).map_err(|e| StoreError::content(file, "JSON", e.to_string()))?;
    let mut notes = Notes { file, events: Vec::new(), points: 0 };
    read(&Node::root(&value, file), &mut notes)?;
    notes.score()
}

/// The events read so far.
struct Notes<'f> {
    file: &'f str,
    events: Vec<Event>,
    points: usize,
}

impl Notes<'_> {
    fn put(&mut self, at: f64, gain: f64, sound: Sound) -> Result<(), StoreError> {
        if self.events.len() >= limits::MOST_EVENTS {
            let expected = format!("at most {} events", limits::MOST_EVENTS);
            return Err(StoreError::content(self.file, expected, "more"));
        }
        self.events.push(Event { at, gain, place: None, sound });
        Ok(())
    }

    fn pulse(&mut self, at: f64, gain: f64) -> Result<(), StoreError> {
        if gain > 0.0 { self.put(at, gain, Sound::Pulse) } else { Ok(()) }
    }

    /// A waveform from its points in s, 0 to 1 and Hz; nothing if it is silent throughout.
    fn wave(
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

    fn score(self) -> Result<Score, StoreError> {
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

/// The frequency in Hz of a pitch from 0 to 1.
fn pitch(share: f64) -> f64 {
    PITCH[0] + share.clamp(0.0, 1.0) * (PITCH[1] - PITCH[0])
}
