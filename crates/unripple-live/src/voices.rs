//! Sustained sounds of the effects' voices: what is wanted, and how the player is brought to play it.

use crate::sounding::{Kept, Sounding};
use crate::{Conductor, LiveError};
use std::sync::Arc;
use std::time::Instant;
use unripple_core::Point;
use unripple_effects::Level;
use unripple_player::{At, Command, Hold, Prepared, PreparedFilters, Voice};

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
        sounding: Sounding,
        asked: Option<u64>,
        at: At,
    ) -> Result<(), LiveError> {
        let crowded = matches!(sounding, Sounding::Wave { .. }) && !self.inputs.any();
        self.tally.crowded += u64::from(crowded);
        // A sound that does not end by itself waits for room, as long as it is wanted.
        let lost = !sounding.goes_on() && (crowded || !self.can_begin());
        let name = self.name(asked);
        let mut kept = Kept::new(sounding, name);
        if !lost {
            self.tell(&mut kept, at)?;
        }
        self.let_go(voice, None, at);
        if kept.hold.is_some() || kept.sounding.goes_on() {
            self.sounding.insert(voice, kept);
        }
        Ok(())
    }

    /// Ends the sound of a voice, by stopping its hold.
    pub(crate) fn let_go(&mut self, voice: u64, fade: Option<u32>, at: At) {
        let Some(Kept { hold: Some(hold), input, .. }) = self.sounding.remove(&voice) else { return };
        hold.stop(at, fade);
        if let Some(input) = input {
            self.inputs.leave(input, hold);
        }
    }

    /// Changes the place or level of a voice's sound.
    pub(crate) fn change(
        &mut self,
        voice: u64,
        other: impl Fn(Sounding) -> Sounding,
        at: At,
    ) -> Result<(), LiveError> {
        let Some(mut kept) = self.sounding.remove(&voice) else { return Ok(()) };
        let before = kept.sounding.clone();
        kept.sounding = other(before.clone());
        let told = self.tell(&mut kept, at);
        if told.is_err() {
            // The new place or level is impossible, so the sound stays as it is.
            kept.sounding = before;
        }
        self.sounding.insert(voice, kept);
        told
    }

    /// Sends the player again the sounds that it may not know. Returns whether there was time for all of them in a
    /// step that began at some instant.
    pub(crate) fn tell_again(&mut self, at: At, began: Instant) -> Result<bool, LiveError> {
        let untold = self.sounding.iter().filter(|(_, kept)| !kept.told).map(|(voice, _)| *voice);
        for voice in untold.collect::<Vec<u64>>() {
            let told = self.change(voice, |sounding| sounding, at);
            if !self.tally.record(told)?
                && let Some(kept) = self.sounding.get_mut(&voice)
            {
                // It would fail each time.
                kept.told = true;
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
        self.sounding.retain(|_, kept| {
            let Some(hold) = &kept.hold else { return !kept.hopeless };
            if hold.over().is_none() {
                return true;
            }
            let again = kept.sounding.goes_on() && !hold.is_stopped() && !kept.hopeless;
            if let Some(input) = kept.input.take() {
                inputs.give(input);
            }
            (kept.hold, kept.told, kept.again) = (None, false, later);
            again
        });
        self.inputs.settle();
        self.ahead.forget_over();
    }

    /// Begins a sound in the player, or changes it there; if there is no room, it is sent again later.
    fn tell(&mut self, kept: &mut Kept, at: At) -> Result<(), LiveError> {
        kept.told = false;
        let early = kept.hold.is_none() && self.desk.clock() < kept.again;
        if early || self.stands || self.desk.room() < CHANGE {
            return Ok(());
        }
        kept.told = match kept.hold {
            None => self.begin(kept, at)?,
            Some(_) => self.redirect(kept, at)?,
        };
        Ok(())
    }

    fn begin(&mut self, kept: &mut Kept, at: At) -> Result<bool, LiveError> {
        let voice = Voice(kept.name);
        let command = match &kept.sounding {
            Sounding::Comb { place, level, period } => {
                let (drive, gain) = self.comb(*place, *level, *period)?;
                Command::Start { voice, drive, at, gain, period: Some(*period) }
            }
            // All inputs may be taken by now if this is not the first attempt.
            Sounding::Wave { .. } if !self.inputs.any() => return Ok(false),
            Sounding::Wave { wave, looped, fade, .. } => {
                let (samples, looped) = (wave.samples.clone(), *looped);
                let rises = (fade * self.rate).round() as u32;
                let Some(filters) = self.filters(&kept.sounding)?.map(|filters| (filters, rises)) else {
                    return Ok(true);
                };
                let Some(input) = self.inputs.take() else { return Ok(false) };
                kept.input = Some(input);
                Command::Wave { voice, input, filters: Some(filters), samples, at, gain: 1.0, looped }
            }
        };
        kept.hold = self.hold(command);
        if kept.hold.is_none()
            && let Some(input) = kept.input.take()
        {
            self.inputs.give(input);
        }
        Ok(kept.hold.is_some())
    }

    fn redirect(&mut self, kept: &Kept, at: At) -> Result<bool, LiveError> {
        let voice = Voice(kept.name);
        if let Sounding::Comb { place, level, period } = &kept.sounding {
            let (drive, gain) = self.comb(*place, *level, *period)?;
            let swapped = self.send(Command::Swap { voice, drive, at });
            return Ok(self.send(Command::Gain { voice, gain, at }) && swapped);
        }
        let Some(input) = kept.input else { return Ok(true) };
        let fade = (GLIDE * self.rate).round() as u32;
        let filters = self.filters(&kept.sounding)?;
        Ok(filters.is_none_or(|filters| self.send(Command::SetFilters { input, filters, at, fade })))
    }

    /// Drive and gain of a comb.
    fn comb(&mut self, place: Point, level: Level, period: f64) -> Result<(Arc<Prepared>, f32), LiveError> {
        let gain = self.pulse_gain(&[place], level)?;
        let drive = self.drives.at(&[place])?.prepared;
        let gain = gain.min(self.drives.even(&drive, period));
        Ok((drive, gain))
    }

    /// Filters through which a waveform passes to focus at its place; none for a repeated focus.
    fn filters(&mut self, sounding: &Sounding) -> Result<Option<Arc<PreparedFilters>>, LiveError> {
        let Sounding::Wave { place, level, wave, .. } = sounding else { return Ok(None) };
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
