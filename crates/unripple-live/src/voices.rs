//! Sustained sounds of the effects' voices: what is wanted, and how the player is brought to play it.

use crate::voice_state::{SustainedSound, VoiceState};
use crate::{Conductor, LiveError};
use std::sync::Arc;
use unripple_core::Point;
use unripple_core::clock::Instant;
use unripple_effects::Level;
use unripple_player::{At, Command, Hold, PreparedDrive, PreparedFilters, Voice};

/// Time over which a moved waveform goes from one place to the next, in s.
const GLIDE: f64 = 0.01;

/// Time after which a sound that found no room in the player is begun again, in s: soon for a finger, and seldom
/// enough to take no room itself.
const AGAIN: f64 = 0.02;

/// Commands that change of place or level may take. So much room is left before anything is sent, so that a change is
/// never half made.
const CHANGE: usize = 2;

impl Conductor {
    /// Starts a sustained sound of a voice, which replaces its previous one.
    pub(crate) fn keep(
        &mut self,
        voice: u64,
        sound: SustainedSound,
        asked: Option<u64>,
        at: At,
    ) -> Result<(), LiveError> {
        let crowded = matches!(sound, SustainedSound::Wave { .. }) && !self.inputs.any();
        self.tally.crowded += u64::from(crowded);
        // A sound that does not end by itself waits for room, as long as it is wanted.
        let lost = !sound.goes_on() && (crowded || !self.can_begin());
        let player_voice = self.new_player_voice(asked);
        let mut state = VoiceState::new(sound, player_voice);
        if !lost {
            self.tell(&mut state, at)?;
        }
        self.let_go(voice, None, at);
        if state.hold.is_some() || state.sound.goes_on() {
            self.sounding.insert(voice, state);
        }
        Ok(())
    }

    /// Ends the sound of a voice, by stopping its hold.
    pub(crate) fn let_go(&mut self, voice: u64, fade: Option<u32>, at: At) {
        let Some(VoiceState { hold: Some(hold), input, .. }) = self.sounding.remove(&voice) else { return };
        hold.stop(at, fade);
        if let Some(input) = input {
            self.inputs.leave(input, hold);
        }
    }

    /// Changes the place or level of a voice's sound.
    pub(crate) fn change(
        &mut self,
        voice: u64,
        other: impl Fn(SustainedSound) -> SustainedSound,
        at: At,
    ) -> Result<(), LiveError> {
        let Some(mut state) = self.sounding.remove(&voice) else { return Ok(()) };
        let before = state.sound.clone();
        state.sound = other(before.clone());
        let told = self.tell(&mut state, at);
        if told.is_err() {
            // The new place or level is impossible, so the sound stays as it is.
            state.sound = before;
        }
        self.sounding.insert(voice, state);
        told
    }

    /// Sends the player again the sounds that it may not know. Returns whether there was time for all of them in a
    /// step that began at some instant.
    pub(crate) fn tell_again(&mut self, at: At, began: Instant) -> Result<bool, LiveError> {
        let untold = self.sounding.iter().filter(|(_, state)| !state.told).map(|(voice, _)| *voice);
        for voice in untold.collect::<Vec<u64>>() {
            let told = self.change(voice, |sound| sound, at);
            if !self.tally.record(told)?
                && let Some(state) = self.sounding.get_mut(&voice)
            {
                // It would fail each time.
                state.told = true;
            }
            if self.is_long(began) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Forgets the sounds that the player reports as over, because they were played to their end or refused. A
    /// sustained sound that was refused for want of room is begun again later.
    pub(crate) fn forget_over(&mut self) {
        let (inputs, later) = (&mut self.inputs, self.desk.clock() + (AGAIN * self.rate) as u64);
        self.sounding.retain(|_, state| {
            let Some(hold) = &state.hold else { return !state.hopeless };
            if hold.over().is_none() {
                return true;
            }
            let again = state.sound.goes_on() && !hold.is_stopped() && !state.hopeless;
            if let Some(input) = state.input.take() {
                inputs.give(input);
            }
            (state.hold, state.told, state.again) = (None, false, later);
            again
        });
        self.inputs.settle();
        self.ahead.forget_over();
    }

    /// Begins a sound in the player, or changes it there; if there is no room, it is sent again later.
    fn tell(&mut self, state: &mut VoiceState, at: At) -> Result<(), LiveError> {
        state.told = false;
        let early = state.hold.is_none() && self.desk.clock() < state.again;
        if early || self.stands || self.desk.room() < CHANGE {
            return Ok(());
        }
        state.told = match state.hold {
            None => self.begin(state, at)?,
            Some(_) => self.redirect(state, at)?,
        };
        Ok(())
    }

    fn begin(&mut self, state: &mut VoiceState, at: At) -> Result<bool, LiveError> {
        let voice = Voice(state.player_voice);
        let command = match &state.sound {
            SustainedSound::Comb { place, level, period } => {
                let (drive, gain) = self.comb(*place, *level, *period)?;
                Command::Start { voice, drive, at, gain, period: Some(*period) }
            }
            // All inputs may be taken by now if this is not the first attempt.
            SustainedSound::Wave { .. } if !self.inputs.any() => return Ok(false),
            SustainedSound::Wave { wave, looped, fade, .. } => {
                let (samples, looped) = (wave.samples.clone(), *looped);
                let rises = (fade * self.rate).round() as u32;
                let Some(filters) = self.filters(&state.sound)?.map(|filters| (filters, rises)) else {
                    return Ok(true);
                };
                let Some(input) = self.inputs.take() else { return Ok(false) };
                state.input = Some(input);
                Command::Wave { voice, input, filters: Some(filters), samples, at, gain: 1.0, looped }
            }
        };
        state.hold = self.hold(command);
        if state.hold.is_none()
            && let Some(input) = state.input.take()
        {
            self.inputs.give(input);
        }
        Ok(state.hold.is_some())
    }

    fn redirect(&mut self, state: &VoiceState, at: At) -> Result<bool, LiveError> {
        let voice = Voice(state.player_voice);
        if let SustainedSound::Comb { place, level, period } = &state.sound {
            let (drive, gain) = self.comb(*place, *level, *period)?;
            let swapped = self.send(Command::Swap { voice, drive, at });
            return Ok(self.send(Command::Gain { voice, gain, at }) && swapped);
        }
        let Some(input) = state.input else { return Ok(true) };
        let fade = (GLIDE * self.rate).round() as u32;
        let filters = self.filters(&state.sound)?;
        Ok(filters.is_none_or(|filters| self.send(Command::SetFilters { input, filters, at, fade })))
    }

    /// Drive and gain of a comb.
    fn comb(
        &mut self,
        place: Point,
        level: Level,
        period: f64,
    ) -> Result<(Arc<PreparedDrive>, f32), LiveError> {
        let gain = self.pulse_gain(&[place], level)?;
        let drive = self.drives.at(&[place])?.prepared;
        let gain = gain.min(self.drives.even(&drive, period));
        Ok((drive, gain))
    }

    /// Filters through which a waveform passes to focus at its place; none for a repeated focus.
    fn filters(&mut self, sound: &SustainedSound) -> Result<Option<Arc<PreparedFilters>>, LiveError> {
        let SustainedSound::Wave { place, level, wave, .. } = sound else { return Ok(None) };
        let (gain, beyond) = self.drives.wave_gain(*place, wave, level.scaled(self.trim))?;
        self.tally.beyond += u64::from(beyond);
        let made = self.drives.at(&[*place])?.made;
        let scaled = |channel: &Vec<f64>| channel.iter().map(|x| (x * gain) as f32).collect();
        let responses: Vec<Vec<f32>> = made.drive.channels().iter().map(scaled).collect();
        Ok(Some(self.desk.filters(&responses)?))
    }

    /// Sends a command for a sound that lasts as long as its hold is kept.
    pub(crate) fn hold(&mut self, command: Command) -> Option<Hold> {
        self.note(&command);
        let held = self.desk.hold(command);
        self.tally.lost += u64::from(held.is_err());
        held.ok()
    }
}
