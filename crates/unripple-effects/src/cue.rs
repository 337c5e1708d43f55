//! Cues: what a player is to play, and when.

use crate::Level;
use std::fmt;
use std::sync::Arc;
use unripple_core::Point;

/// A timed command for a player: what a voice is to do, and when.
///
/// A voice belongs to one part of one effect, for one contact of one finger (from touch to lift). Its number is not used again.
/// [`Act::Move`], [`Act::Gain`] and [`Act::Stop`] refer to what the voice last started.
#[derive(Clone, Debug, PartialEq)]
pub struct Cue {
    /// Number that identifies the voice: its bits hold the numbers of the contact, of the effect, and of the
    /// effect's part.
    pub voice: u64,
    /// Time at which the act is due, in s of the clock that times the touches. An act whose time has passed
    /// is due at once.
    pub at: f64,
    /// What the voice is to do.
    pub act: Act,
}

/// What a voice is to do.
///
/// `Pulse` and `Shape` are single pulses that end by themselves. `Comb` and `Wave` last until they end or are stopped, and replace
/// what the voice was playing.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// Plays one focused pulse at a place.
    Pulse {
        /// Where it is focused, in m.
        place: Point,
        /// Level of the pulse.
        gain: Level,
    },
    /// Repeats a focused pulse periodically until the voice is stopped.
    Comb {
        /// Where it is focused, in m.
        place: Point,
        /// Pulses per second.
        rate: f64,
        /// Level of each pulse.
        gain: Level,
    },
    /// Plays a waveform at a place.
    Wave {
        /// Where the waveform is felt, in m.
        place: Point,
        /// The waveform, with a full scale of 1.
        wave: Wave,
        /// Level at which a sample value of 1 is played.
        gain: Level,
        /// Whether the waveform repeats until it is stopped. The last sample of such a waveform continues
        /// into its first without a step.
        looped: bool,
        /// Duration of the fade-in, in s.
        fade: f64,
    },
    /// Plays one pulse that is focused on many points at the same instant.
    Shape {
        /// The points, in m.
        points: Arc<[Point]>,
        /// Level of the pulse on all points together.
        gain: Level,
    },
    /// Moves the voice, and what it is playing, to another place.
    Move {
        /// The new place, in m.
        place: Point,
    },
    /// Changes the level of the voice.
    Gain {
        /// The new level, which also applies to what is being played.
        gain: Level,
    },
    /// Ends the voice. Its cues for later times are dropped.
    Stop {
        /// Duration of the fade-out, in s.
        fade: f64,
    },
}

/// A sampled waveform; its samples are shared, not copied, between clones.
#[derive(Clone, PartialEq)]
pub struct Wave {
    /// The samples, between -1 and 1.
    pub samples: Arc<[f32]>,
    /// Samples per second.
    pub rate: f64,
}

impl Wave {
    /// Duration of the waveform, in s.
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / self.rate
    }
}

impl fmt::Debug for Wave {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Wave({} samples at {} Hz)", self.samples.len(), self.rate)
    }
}
