//! Commands for the audio thread, and when they act.

use crate::{PreparedDrive, PreparedFilters};
use std::sync::Arc;

/// A number, chosen by the sender for a drive or waveform that it starts, by which later commands and
/// reports refer to it. Starting a repeating drive with the number of one that repeats already replaces that
/// one.
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

/// A command to a player. Combs, loops and looped waveforms, which play until they are ended, are sent with
/// [`Desk::hold`](crate::Desk::hold) and end with their [`Hold`](crate::Hold).
#[derive(Clone, Debug)]
pub enum Command {
    /// Starts a drive: once, as a comb or as a loop.
    Start {
        /// Number of the voice, by which later commands and reports refer to it.
        voice: Voice,
        /// The drive that is played.
        drive: Arc<PreparedDrive>,
        /// When the first sample of the drive is emitted.
        at: At,
        /// Factor on the drive; the limiter may lower it.
        gain: f32,
        /// For a comb, the interval from each start to the next, in samples, at least one block; each start is rounded
        /// to a sample. With `None` a drive is played once, and a loop is repeated without a gap.
        period: Option<f64>,
    },
    /// Gives a comb or loop another drive: each copy that starts at or after `at` plays the new drive, while copies of
    /// the old one that have begun play to their end. Passes of a loop overlap by its fade, so this is a crossfade of
    /// that length.
    Swap {
        /// Voice number of the comb or loop.
        voice: Voice,
        /// The new drive. A comb keeps its period.
        drive: Arc<PreparedDrive>,
        /// Copies that start from here on play the new drive.
        at: At,
    },
    /// Gives the copies of a comb or loop that start at or after `at` another gain.
    Gain {
        /// Voice number of the comb or loop.
        voice: Voice,
        /// Factor on the drive; the limiter may lower it.
        gain: f32,
        /// Copies that start from here on have the new gain.
        at: At,
    },
    /// Sets the impulse responses from an input to all outputs. Samples that entered the input before are
    /// convolved with the old responses to their end; those that enter during the fade are convolved with
    /// both, with weights that change linearly from old to new.
    SetFilters {
        /// Index of the input.
        input: usize,
        /// Responses from the input to all outputs.
        filters: Arc<PreparedFilters>,
        /// When the fade begins: with the block that holds this sample.
        at: At,
        /// Length of the fade in samples: rounded up to whole blocks, and at least one block.
        fade: u32,
    },
    /// Plays a prepared waveform into an input.
    Wave {
        /// Voice number by which reports refer to the waveform.
        voice: Voice,
        /// Index of the input.
        input: usize,
        /// Responses that the input uses for this waveform, and the length in samples of the cross-fade from
        /// its present responses. If these responses are refused, so is the waveform; after the waveform has
        /// ended, the input has no responses. With `None`, the input keeps its present responses.
        filters: Option<(Arc<PreparedFilters>, u32)>,
        /// Samples of the waveform, at the player's sample rate.
        samples: Arc<[f32]>,
        /// When the first sample of the waveform enters the input.
        at: At,
        /// Factor on the waveform, before limiting.
        gain: f32,
        /// Whether the waveform is repeated until it is ended, or played once.
        looped: bool,
    },
}

impl Command {
    /// When the command acts, by the player's clock.
    pub fn at(&self) -> At {
        match self {
            Self::Start { at, .. }
            | Self::Swap { at, .. }
            | Self::Gain { at, .. }
            | Self::SetFilters { at, .. }
            | Self::Wave { at, .. } => *at,
        }
    }

    /// Whether the command begins a comb, loop or looped waveform, which plays until it is ended.
    pub(crate) fn goes_on(&self) -> bool {
        match self {
            Self::Start { drive, period, .. } => period.is_some() || drive.every().is_some(),
            Self::Wave { looped, .. } => *looped,
            _ => false,
        }
    }

    /// Whether the command begins a drive or waveform that is played once.
    pub(crate) fn is_passing(&self) -> bool {
        matches!(self, Self::Start { .. } | Self::Wave { .. }) && !self.goes_on()
    }

    /// The voice that the command concerns; `None` for filters.
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

/// A report of the player to its desk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Report {
    /// A copy of a drive, or a waveform, starts.
    Started {
        /// Number of the voice.
        voice: Voice,
        /// Sample of the clock at which it starts.
        sample: u64,
        /// Gain with which it starts, after limiting.
        gain: f32,
    },
    /// The last copy of a voice, or a waveform, has ended.
    Ended {
        /// Number of the voice.
        voice: Voice,
        /// First sample of the player's clock at which the voice is silent.
        sample: u64,
    },
    /// A copy of a drive was scaled down as a whole, to stay within a limit of an actuator.
    Limited {
        /// Number of the voice.
        voice: Voice,
        /// Ratio of the gain after limiting to the gain requested, below 1.
        scale: f32,
        /// Kind of limit that required the reduction.
        which: Which,
        /// Index of the actuator whose limit it is.
        output: usize,
    },
    /// The common gain of all waveforms begins to be reduced, to stay within a limit.
    WavesLimited {
        /// First sample of the block in which the reduction begins.
        sample: u64,
        /// The common gain at the end of that block, below 1.
        gain: f32,
        /// Kind of limit that required the reduction.
        which: Which,
        /// Index of the actuator whose limit it is.
        output: usize,
    },
    /// A command acts later than requested: its sample had passed already, or the work allowed in its block
    /// was used up.
    Late {
        /// Number of the voice; `None` for filters.
        voice: Option<Voice>,
        /// Delay of the command's action, in samples.
        by: u64,
    },
    /// A command was refused: nothing was done.
    Refused {
        /// Number of the voice; `None` for filters.
        voice: Option<Voice>,
        /// The reason; [`Why::may_pass`] says whether the command may succeed later.
        why: Why,
    },
}

/// Kind of limit of an actuator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// The limit on the largest sample.
    Peak,
    /// The limit on the running rms over a short time.
    Rms,
    /// The limit on the running rms over a long time.
    Thermal,
}

/// Reason why a command was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// The largest number of repeating voices, [`Options::voices`](crate::Options::voices), or of holds is
    /// reached.
    Voices,
    /// The largest number of copies of drives, or of waveforms, is being played already.
    Copies,
    /// The largest number of commands that can wait for their sample is waiting already.
    Pending,
    /// No repeating voice has this number.
    Unknown,
    /// The drive's number of outputs differs from the player's, or the filters were not prepared with a plan
    /// of the player's sizes.
    Outputs,
    /// The drive is longer than [`Options::longest`](crate::Options::longest), or the waveform is empty.
    Samples,
    /// The gain is not a finite number.
    Gain,
    /// The period is shorter than a block, or not a number.
    Period,
    /// The player has no input of this index, or was made without inputs for waveforms.
    Input,
    /// The command is out of date: it was cancelled with [`Desk::withdraw`](crate::Desk::withdraw), its hold
    /// was released before it began, or its start was postponed for longer than its drive lasts.
    Stale,
}

impl Why {
    /// Whether the same command may succeed later: it was refused because of the player's state, not because of its
    /// contents.
    pub fn may_pass(self) -> bool {
        match self {
            Self::Voices | Self::Copies | Self::Pending | Self::Unknown | Self::Stale => true,
            Self::Outputs | Self::Samples | Self::Gain | Self::Period | Self::Input => false,
        }
    }
}
