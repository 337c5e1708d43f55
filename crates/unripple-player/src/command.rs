//! Commands for the audio thread, and when they act.

use crate::{Prepared, PreparedFilters};
use std::sync::Arc;

/// A name that the sender gives to what it starts, for changes and reports; starting a repeating voice under the name of another replaces it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Voice(pub u64);

/// When a command acts, by the player's clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum At {
    /// At the first sample of the next block.
    #[default]
    Now,
    /// At this sample of the player's clock.
    Sample(u64),
}

/// What is asked of a player. What goes on until somebody ends it is sent with [`Desk::hold`](crate::Desk::hold) and ends with its
/// [`Hold`](crate::Hold).
#[derive(Clone, Debug)]
pub enum Command {
    /// Starts a drive: once, as a comb or as a loop.
    Start {
        /// Name by which the voice is changed and reported.
        voice: Voice,
        /// The drive that is played.
        drive: Arc<Prepared>,
        /// When its first sample sounds.
        at: At,
        /// Factor; the limiter may lower it.
        gain: f32,
        /// Samples from each start to the next, each rounded to a sample, of a comb; at least one block. `None` plays a drive
        /// once, and a loop for ever.
        period: Option<f64>,
    },
    /// Gives a comb or loop another drive: each start at or after `at` plays that, while the last copies of the old ring out.
    /// Passes of a loop overlap by its fade, so this is a crossfade of that length.
    Swap {
        /// Name of the comb or loop.
        voice: Voice,
        /// What is played from then on. The period stays.
        drive: Arc<Prepared>,
        /// From when on starts play it.
        at: At,
    },
    /// Gives the copies of a comb or loop that start at or after `at` another gain.
    Gain {
        /// Name of the comb or loop.
        voice: Voice,
        /// Factor on the drive; the limiter may lower it.
        gain: f32,
        /// From when on starts have it.
        at: At,
    },
    /// Gives an input its responses to all outputs. What entered before keeps the old responses to its end, what enters during the
    /// fade goes through both in turning shares.
    SetFilters {
        /// Index of the input.
        input: usize,
        /// Its responses to all outputs.
        filters: Arc<PreparedFilters>,
        /// From the block that holds this sample.
        at: At,
        /// Samples of the fade, rounded up to whole blocks, at least one.
        fade: u32,
    },
    /// Plays a prepared waveform into an input.
    Wave {
        /// Name by which the waveform is reported.
        voice: Voice,
        /// Index of the input.
        input: usize,
        /// Responses that the input gets for this waveform, and samples of the fade from those it has: both come or neither. When
        /// the waveform is over, the input has none. `None` leaves the input as it is.
        filters: Option<(Arc<PreparedFilters>, u32)>,
        /// The waveform, at the full rate.
        samples: Arc<[f32]>,
        /// When its first sample enters.
        at: At,
        /// Factor on the waveform.
        gain: f32,
        /// Whether it plays for ever, or once.
        looped: bool,
    },
}

impl Command {
    /// When it acts, by the player's clock.
    pub fn at(&self) -> At {
        match self {
            Self::Start { at, .. }
            | Self::Swap { at, .. }
            | Self::Gain { at, .. }
            | Self::SetFilters { at, .. }
            | Self::Wave { at, .. } => *at,
        }
    }

    /// Whether it begins something that goes on until it is ended.
    pub(crate) fn goes_on(&self) -> bool {
        match self {
            Self::Start { drive, period, .. } => period.is_some() || drive.every().is_some(),
            Self::Wave { looped, .. } => *looped,
            _ => false,
        }
    }

    /// Whether it begins something that is over by itself.
    pub(crate) fn is_passing(&self) -> bool {
        matches!(self, Self::Start { .. } | Self::Wave { .. }) && !self.goes_on()
    }

    /// The voice that it is about; none of filters.
    pub fn voice(&self) -> Option<Voice> {
        match self {
            Self::Start { voice, .. }
            | Self::Swap { voice, .. }
            | Self::Gain { voice, .. }
            | Self::Wave { voice, .. } => Some(*voice),
            Self::SetFilters { .. } => None,
        }
    }
}

/// What a player reports to its desk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Report {
    /// A copy of a drive, or a waveform, starts.
    Started {
        /// Name of the voice.
        voice: Voice,
        /// Sample of the clock at which it starts.
        sample: u64,
        /// Factor that it starts with, after limiting.
        gain: f32,
    },
    /// The last copy, or the waveform, is over.
    Ended {
        /// Name of the voice.
        voice: Voice,
        /// First sample of silence.
        sample: u64,
    },
    /// A copy of a drive was scaled down as a whole, to stay within a limit.
    Limited {
        /// Name of the voice.
        voice: Voice,
        /// The gain that was asked for is multiplied by this.
        scale: f32,
        /// The limit that decided.
        which: Which,
        /// Index of the actuator.
        output: usize,
    },
    /// All waveforms together begin to be scaled down.
    WavesLimited {
        /// First sample of the block in which that begins.
        sample: u64,
        /// The gain at the end of that block.
        gain: f32,
        /// The limit that decided.
        which: Which,
        /// Index of the actuator.
        output: usize,
    },
    /// The asked sample had passed, or its block was full of work: it acts now.
    Late {
        /// Name of the voice; none for filters.
        voice: Option<Voice>,
        /// Number of samples that it is late by.
        by: u64,
    },
    /// A command was refused: nothing was done.
    Refused {
        /// Name of the voice; none for filters.
        voice: Option<Voice>,
        /// The reason, which says whether it may pass another time.
        why: Why,
    },
}

/// Which limit of an actuator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// The limit on the largest sample.
    Peak,
    /// The limit on the running rms over a short time.
    Rms,
    /// The limit on the running rms over a long time.
    Thermal,
}

/// Why a command was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// As many voices as there may be.
    Voices,
    /// As many copies or waveforms sound as may.
    Copies,
    /// As many commands wait for their sample as may.
    Pending,
    /// No voice of that name repeats.
    Unknown,
    /// A drive of another number of outputs, or filters of another plan.
    Outputs,
    /// A drive longer than the longest, or an empty waveform.
    Samples,
    /// A gain that is not finite.
    Gain,
    /// A period of less than a block, or not a number.
    Period,
    /// No such input, or no waveforms at all.
    Input,
    /// Too late to be wanted: taken back with [`Desk::withdraw`](crate::Desk::withdraw), or put off for longer than it lasts.
    Stale,
}

impl Why {
    /// Whether the same may be obeyed another time: it was not for what was asked for.
    pub fn may_pass(self) -> bool {
        match self {
            Self::Voices | Self::Copies | Self::Pending | Self::Unknown | Self::Stale => true,
            Self::Outputs | Self::Samples | Self::Gain | Self::Period | Self::Input => false,
        }
    }
}
