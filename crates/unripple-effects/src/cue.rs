//! What an effect wants played, and when.

use crate::Level;
use std::fmt;
use std::sync::Arc;
use unripple_core::Point;

/// Something to play, and when.
///
/// A voice is one part of one effect under one contact of one finger, and never another before or after. Acts of a
/// voice refer to what that voice last started.
#[derive(Clone, Debug, PartialEq)]
pub struct Cue {
    /// Number of the voice, from contact, effect and part.
    pub voice: u64,
    /// When, in s of the touches' clock. What lies in the past is due at once.
    pub at: f64,
    /// What the voice does then.
    pub act: Act,
}

/// What a voice does.
///
/// `Pulse` and `Shape` are over by themselves. `Comb` and `Wave` sound until they end or are stopped, and replace what
/// the voice was sounding.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// One focused pulse at a place.
    Pulse {
        /// Where it is focused, in m.
        place: Point,
        /// How strong, as a share or in dB.
        gain: Level,
    },
    /// A focus repeated until it is stopped.
    Comb {
        /// Where it is focused, in m.
        place: Point,
        /// Pulses per second.
        rate: f64,
        /// How strong each pulse is.
        gain: Level,
    },
    /// A waveform at a place.
    Wave {
        /// Where it is felt, in m.
        place: Point,
        /// The waveform; its full scale, 1, is the level.
        wave: Wave,
        /// How strong it is at full scale.
        gain: Level,
        /// Whether it starts over at its end, until it is stopped. Such a waveform meets itself without a step.
        looped: bool,
        /// Time over which it rises, in s.
        fade: f64,
    },
    /// One focused pulse on many points at once.
    Shape {
        /// Where, in m: all points at once.
        points: Arc<[Point]>,
        /// How strong, all points together.
        gain: Level,
    },
    /// The voice's place from now on.
    Move {
        /// The new place, in m.
        place: Point,
    },
    /// The voice's level from now on.
    Gain {
        /// The new level, of what sounds too.
        gain: Level,
    },
    /// The voice ends. Its acts that were cued for later times are not played.
    Stop {
        /// Time over which it falls, in s.
        fade: f64,
    },
}

/// Samples of a waveform, shared rather than copied.
#[derive(Clone, PartialEq)]
pub struct Wave {
    /// The samples, between -1 and 1.
    pub samples: Arc<[f32]>,
    /// Samples per second.
    pub rate: f64,
}

impl Wave {
    /// How long it lasts, in s.
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / self.rate
    }
}

impl fmt::Debug for Wave {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Wave({} samples at {} Hz)", self.samples.len(), self.rate)
    }
}
