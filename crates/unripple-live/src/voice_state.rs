//! Sustained sounds of a voice: a repeated focus, or a waveform.

use unripple_core::Point;
use unripple_effects::{Level, Wave};
use unripple_player::Hold;

/// A sustained sound of a voice, until it is stopped or over.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SustainedSound {
    /// A repeated focus, and the samples from each to the next.
    Comb { place: Point, level: Level, period: f64 },
    /// A waveform, for ever or once, and the time over which it rises, in s.
    Wave { place: Point, level: Level, wave: Wave, looped: bool, fade: f64 },
}

impl SustainedSound {
    /// This sound at another place, in m.
    pub fn moved(mut self, to: Point) -> Self {
        let (Self::Comb { place, .. } | Self::Wave { place, .. }) = &mut self;
        *place = to;
        self
    }

    /// This sound at another level.
    pub fn at_level(mut self, to: Level) -> Self {
        let (Self::Comb { level, .. } | Self::Wave { level, .. }) = &mut self;
        *level = to;
        self
    }

    /// Whether the sound goes on until it is stopped, and so is worth beginning late.
    pub fn goes_on(&self) -> bool {
        matches!(self, Self::Comb { .. } | Self::Wave { looped: true, .. })
    }
}

/// State of a voice: the sound that is to be played, and what the player has been told of it.
#[derive(Debug)]
pub(crate) struct VoiceState {
    /// The sound, its place and level.
    pub sound: SustainedSound,
    /// Voice number of the sound in the player; no other sound has the same.
    pub player_voice: u64,
    /// Handle that keeps the sound playing; `None` while the player has not been sent the sound.
    pub hold: Option<Hold>,
    /// Index of the player's input that the sound occupies, if it is a waveform.
    pub input: Option<usize>,
    /// Whether the player has been sent the newest place and level of the sound.
    pub told: bool,
    /// Sample of the player's clock before which the sound is not begun again.
    pub again: u64,
    /// Whether the player refuses the sound because of its contents, not for lack of room.
    pub hopeless: bool,
}

impl VoiceState {
    /// A sound that has not been sent to the player yet; `player_voice` is a number that no other sound has.
    pub fn new(sound: SustainedSound, player_voice: u64) -> Self {
        Self { sound, player_voice, hold: None, input: None, told: false, again: 0, hopeless: false }
    }
}

/// The player's inputs for waveforms. An input is free again once the player reports that the waveform through it is
/// over: then nothing enters it, and its filters lead nowhere.
#[derive(Debug)]
pub(crate) struct Inputs {
    free: Vec<bool>,
    /// Inputs of waveforms that were stopped and may still sound.
    leaving: Vec<(usize, Hold)>,
}

impl Inputs {
    /// Inputs of a player that has `count` of them.
    pub fn new(count: usize) -> Self {
        Self { free: vec![true; count], leaving: Vec::new() }
    }

    /// Takes a free input, and returns its index; `None` if none is free.
    pub fn take(&mut self) -> Option<usize> {
        let input = self.free.iter().position(|free| *free)?;
        self.free[input] = false;
        Some(input)
    }

    /// Whether an input is free.
    pub fn any(&self) -> bool {
        self.free.contains(&true)
    }

    /// Whether all inputs are free.
    pub fn rest(&self) -> bool {
        self.leaving.is_empty() && self.free.iter().all(|free| *free)
    }

    /// Frees an input that no waveform uses any more.
    pub fn give(&mut self, input: usize) {
        if let Some(free) = self.free.get_mut(input) {
            *free = true;
        }
    }

    /// Notes that the waveform through an input, given by its number, was stopped: [`Self::settle`] frees the input once the waveform's
    /// handle `hold` reports that it is over.
    pub fn leave(&mut self, input: usize, hold: Hold) {
        self.leaving.push((input, hold));
    }

    /// Frees the inputs of stopped waveforms that are over.
    pub fn settle(&mut self) {
        let free = &mut self.free;
        self.leaving.retain(|(input, hold)| {
            let over = hold.over().is_some();
            if over && let Some(free) = free.get_mut(*input) {
                *free = true;
            }
            !over
        });
    }
}
