use crate::log::{Began, Log};
use crate::sounding::{Inputs, Sounding};
use crate::{Drives, LiveError, Maker, Tally, Timing};
use std::collections::BTreeMap;
use std::sync::Arc;
use unripple_core::{Point, Touch};
use unripple_effects::{Act, Cue, Effects, Level, Wave};
use unripple_player::{At, Command, Desk, Prepared, Report, Voice};
use unripple_touch::{Heard, Wish};

/// Cues that may wait for their time; more are counted and dropped.
const MOST_WAITING: usize = 1 << 16;

/// Voices whose touches are remembered until they start.
const MOST_ASKED: usize = 1 << 12;

/// The player's name of pings.
const PING: u64 = u64::MAX;

/// Set in the player's names of waveforms, which are none of the effects' voices.
const WAVES: u64 = 1 << 63;

/// A pulse that is begun so late, in s, is not begun at all.
const STALE: f64 = 0.1;

/// Time over which a moved waveform goes from one place to the next, in s.
const GLIDE: f64 = 0.01;

/// Turns what touches set off into commands for a player: cues wait here for their time, drives are made or remembered, and what
/// sounds follows the finger.
///
/// A focus comes a window after its drive begins. So what is known ahead, as in a score, begins a window early; what a touch sets off
/// begins at once.
///
/// Deterministic: the same touches at the same samples give the same commands.
pub struct Conductor {
    effects: Effects,
    drives: Drives,
    desk: Desk,
    rate: f64,
    /// Samples from the beginning of a drive to its focus.
    lead: u64,
    waiting: BTreeMap<(u64, u64), Cue>,
    order: u64,
    sounding: BTreeMap<u64, Sounding>,
    inputs: Inputs,
    /// Waveforms begun so far.
    waves: u64,
    /// Factor on all levels.
    trim: f64,
    /// When the touch came that a voice answers, in samples.
    asked: BTreeMap<u64, u64>,
    cues: Vec<Cue>,
    tally: Tally,
    /// What each voice plays, and what of it has begun, while somebody wants to know.
    log: Option<Log>,
}

impl std::fmt::Debug for Conductor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Conductor").field("waiting", &self.waiting.len()).field("tally", &self.tally).finish()
    }
}

impl Conductor {
    /// Effects played through a desk, whose player has so many inputs for waveforms and so many outputs.
    pub fn new(
        effects: Effects,
        drives: Drives,
        desk: Desk,
        time: Timing,
        inputs: usize,
        outputs: usize,
    ) -> Self {
        let Timing { rate, window, block } = time;
        Self {
            effects,
            drives,
            desk,
            rate,
            lead: (window * rate).round() as u64,
            waiting: BTreeMap::new(),
            order: 0,
            sounding: BTreeMap::new(),
            inputs: Inputs::new(inputs, outputs, block),
            waves: 0,
            trim: 1.0,
            asked: BTreeMap::new(),
            cues: Vec::new(),
            tally: Tally::default(),
            log: None,
        }
    }

    /// Lets drives be made with real-time priority, where the system grants it.
    pub fn hurry(&mut self) {
        self.drives.hurry();
    }

    /// Plays a drive that asks the sheet for its tension, at once.
    pub(crate) fn ping(&mut self, drive: Arc<Prepared>) {
        self.send(Command::Start { voice: Voice(PING), drive, at: At::Now, gain: 1.0, period: None });
    }

    /// Keeps, from now on, which drives begin, for [`Conductor::began`].
    pub fn keep_log(&mut self) {
        self.log = Some(Log::default());
    }

    /// Drives that began since this was last asked, as far as the player has told: what began in a block is told after it.
    pub fn began(&mut self) -> Vec<Began> {
        self.listen();
        self.log.as_mut().map_or_else(Vec::new, Log::take)
    }

    /// What was played and what was not.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// The player's other end.
    pub fn desk(&self) -> &Desk {
        &self.desk
    }

    /// Drives made so far, and those remembered.
    pub fn drives(&self) -> &Drives {
        &self.drives
    }

    /// Takes in what was heard, and gives the player all that begins before `until`, both in samples of the player's clock; `now` is
    /// the first sample of the next block. Touches carry the same clock in s.
    ///
    /// # Errors
    /// [`LiveError::Gone`] if no drive can be made any more; what fails for one cue is counted.
    pub fn step(&mut self, heard: &Heard, now: u64, until: u64) -> Result<(), LiveError> {
        self.listen();
        let mut cues = std::mem::take(&mut self.cues);
        for touch in &heard.touches {
            self.effects.touch(touch, &mut cues);
            self.queue(&mut cues, now, Some(touch));
        }
        for wish in &heard.wishes {
            self.wish(wish, now);
        }
        self.effects.tick((until + self.lead) as f64 / self.rate, &mut cues);
        self.queue(&mut cues, now, None);
        self.cues = cues;
        self.inputs.free(now, &mut self.desk);
        while let Some(entry) = self.waiting.first_entry().filter(|entry| entry.key().0 < until) {
            let ((sample, _), cue) = entry.remove_entry();
            let played = self.play(&cue, sample, now);
            self.tally.cues += u64::from(self.tally.went(played)?);
        }
        Ok(())
    }

    /// Goes on with another maker: what sounds goes over to drives for the surface as it is now.
    ///
    /// # Errors
    /// [`LiveError::Gone`] if no drive can be made any more.
    pub fn renew(&mut self, maker: Maker, now: u64) -> Result<(), LiveError> {
        self.drives.replace(maker);
        let all: Vec<(u64, Sounding)> = self.sounding.iter().map(|(voice, s)| (*voice, s.clone())).collect();
        for (voice, sounding) in all {
            let redirected = self.redirect(voice, &sounding, At::Sample(now));
            self.tally.went(redirected)?;
        }
        Ok(())
    }

    /// The sample nearest to a time in s.
    fn sample(&self, time: f64) -> u64 {
        (time * self.rate).round().max(0.0) as u64
    }

    /// Puts cues where they wait for the beginning of their drives.
    fn queue(&mut self, cues: &mut Vec<Cue>, now: u64, touch: Option<&Touch>) {
        for cue in cues.drain(..) {
            let focus = self.sample(cue.at);
            let sample = focus.saturating_sub(self.lead).max(now);
            let late = now.saturating_sub(focus) as f64 / self.rate;
            if late > STALE && matches!(cue.act, Act::Pulse { .. } | Act::Shape { .. }) {
                // Nobody feels now what was asked for then; making it would only make the next later.
                self.tally.stale += 1;
                continue;
            }
            if let Act::Stop { .. } = cue.act {
                self.waiting.retain(|(at, _), other| other.voice != cue.voice || *at < sample);
            } else if self.waiting.len() >= MOST_WAITING {
                self.tally.dropped += 1;
                continue;
            }
            if let Some(touch) = touch {
                let asked = self.sample(touch.time);
                self.asked.entry(cue.voice).or_insert(asked);
                if self.asked.len() > MOST_ASKED {
                    self.asked.pop_first();
                }
            }
            self.order += 1;
            self.waiting.insert((sample, self.order), cue);
        }
    }

    fn wish(&mut self, wish: &Wish, now: u64) {
        match wish {
            Wish::Effect(name) => {
                let at = (now + self.lead) as f64 / self.rate;
                if let Err(error) = self.effects.start(name, at, None) {
                    self.tally.fail(&error);
                }
            }
            Wish::Gain(db) => self.trim = 10f64.powf(db / 20.0),
        }
    }

    fn play(&mut self, cue: &Cue, sample: u64, now: u64) -> Result<(), LiveError> {
        let at = if sample <= now { At::Now } else { At::Sample(sample) };
        match &cue.act {
            Act::Pulse { place, gain } => self.start(cue.voice, &[*place], *gain, None, at),
            Act::Shape { points, gain } => self.start(cue.voice, points, *gain, None, at),
            Act::Comb { place, rate, gain } => {
                let period = (self.rate / rate).round();
                self.start(cue.voice, &[*place], *gain, Some(period), at)?;
                let comb = Sounding::Comb { place: *place, level: *gain, period };
                self.replace(cue.voice, comb, at);
                Ok(())
            }
            Act::Wave { place, wave, gain, looped, fade } => {
                self.wave(cue.voice, *place, wave, *gain, (*looped, *fade), at)
            }
            Act::Move { place } => self.change(cue.voice, |sounding| sounding.moved(*place), at),
            Act::Gain { gain } => self.change(cue.voice, |sounding| sounding.at_level(*gain), at),
            Act::Stop { fade } => self.stop(cue.voice, *fade, at, sample),
        }
    }

    fn start(
        &mut self,
        voice: u64,
        points: &[Point],
        level: Level,
        period: Option<f64>,
        at: At,
    ) -> Result<(), LiveError> {
        let gain = self.pulse_gain(points, level)?;
        let drive = self.drives.at(points)?.prepared;
        let gain = period.map_or(gain, |period| gain.min(self.drives.even(&drive, period)));
        self.send(Command::Start { voice: Voice(voice), drive, at, gain, period });
        Ok(())
    }

    fn wave(
        &mut self,
        voice: u64,
        place: Point,
        wave: &Wave,
        level: Level,
        (looped, fade): (bool, f64),
        at: At,
    ) -> Result<(), LiveError> {
        let Some(input) = self.inputs.take(voice) else {
            self.tally.crowded += 1;
            return Ok(());
        };
        self.waves += 1;
        let id = WAVES | self.waves;
        let sounding = Sounding::Wave { input, id, place, wave: wave.clone(), level };
        self.replace(voice, sounding.clone(), at);
        self.filter(&sounding, fade, at)?;
        if let Some(asked) = self.asked.remove(&voice) {
            self.asked.insert(id, asked);
        }
        let samples = wave.samples.clone();
        self.send(Command::Wave { voice: Voice(id), input, samples, at, gain: 1.0, looped });
        Ok(())
    }

    /// Gives what a voice sounds another place or level.
    fn change(&mut self, voice: u64, other: impl Fn(Sounding) -> Sounding, at: At) -> Result<(), LiveError> {
        let Some(sounding) = self.sounding.get(&voice).cloned() else { return Ok(()) };
        let sounding = other(sounding);
        self.redirect(voice, &sounding, at)?;
        self.sounding.insert(voice, sounding);
        Ok(())
    }

    fn redirect(&mut self, voice: u64, sounding: &Sounding, at: At) -> Result<(), LiveError> {
        match sounding {
            Sounding::Comb { place, level, period } => {
                let gain = self.pulse_gain(&[*place], *level)?;
                let drive = self.drives.at(&[*place])?.prepared;
                let gain = gain.min(self.drives.even(&drive, *period));
                self.send(Command::Swap { voice: Voice(voice), drive, at });
                self.send(Command::Gain { voice: Voice(voice), gain, at });
                Ok(())
            }
            Sounding::Wave { .. } => self.filter(sounding, GLIDE, at),
        }
    }

    /// Points the input of a waveform at its place.
    fn filter(&mut self, sounding: &Sounding, fade: f64, at: At) -> Result<(), LiveError> {
        let Sounding::Wave { input, place, wave, level, .. } = sounding else { return Ok(()) };
        let (gain, beyond) = self.drives.wave_gain(*place, wave, level.scaled(self.trim))?;
        self.tally.beyond += u64::from(beyond);
        let made = self.drives.at(&[*place])?.made;
        let scaled = |channel: &Vec<f64>| channel.iter().map(|x| (x * gain) as f32).collect();
        let responses: Vec<Vec<f32>> = made.drive.channels().iter().map(scaled).collect();
        let filters = self.desk.filters(&responses)?;
        let fade = (fade * self.rate).round() as u32;
        self.send(Command::SetFilters { input: *input, filters, at, fade });
        Ok(())
    }

    fn pulse_gain(&mut self, points: &[Point], level: Level) -> Result<f32, LiveError> {
        let (gain, beyond) = self.drives.pulse_gain(points, level.scaled(self.trim))?;
        self.tally.beyond += u64::from(beyond);
        Ok(gain as f32)
    }

    /// Notes what a voice sounds from now on, instead of what it sounded.
    fn replace(&mut self, voice: u64, sounding: Sounding, at: At) {
        let old = self.sounding.insert(voice, sounding);
        if let Some(Sounding::Wave { input, id, .. }) = old {
            let silent = match at {
                At::Now => self.desk.clock(),
                At::Sample(sample) => sample,
            };
            self.send(Command::Stop { voice: Voice(id), at, fade: Some(0) });
            self.inputs.give(input, silent, &mut self.desk);
        }
    }

    fn stop(&mut self, voice: u64, fade: f64, at: At, sample: u64) -> Result<(), LiveError> {
        self.asked.remove(&voice);
        let samples = (fade * self.rate).round() as u32;
        match self.sounding.remove(&voice) {
            None => {}
            Some(Sounding::Comb { .. }) => {
                let fade = (samples > 0).then_some(samples);
                self.send(Command::Stop { voice: Voice(voice), at, fade });
            }
            Some(Sounding::Wave { input, id, .. }) => {
                self.send(Command::Stop { voice: Voice(id), at, fade: Some(samples) });
                self.inputs.give(input, sample + u64::from(samples), &mut self.desk);
            }
        }
        Ok(())
    }

    /// A waveform that was played once is over.
    fn end(&mut self, ended: u64, silent: u64) {
        let over = self.sounding.iter().find_map(|(voice, sounding)| match sounding {
            Sounding::Wave { input, id, .. } if *id == ended => Some((*voice, *input)),
            _ => None,
        });
        if let Some((voice, input)) = over {
            self.sounding.remove(&voice);
            self.inputs.give(input, silent, &mut self.desk);
        }
    }

    fn send(&mut self, command: Command) {
        if let Some(log) = &mut self.log {
            log.send(&command);
        }
        self.tally.lost += u64::from(self.desk.send(command).is_err());
    }

    /// Hears what the player says.
    fn listen(&mut self) {
        while let Some(report) = self.desk.report() {
            if let Report::Ended { voice, sample } = report {
                self.end(voice.0, sample);
            }
            if let Some(log) = &mut self.log {
                log.hear(&report);
            }
            if let Report::Started { voice, sample, .. } = report
                && let Some(asked) = self.asked.remove(&voice.0)
            {
                let late = sample.saturating_sub(asked);
                self.tally.first_sample.add(late as f64 / self.rate);
                self.tally.focus.add((late + self.lead) as f64 / self.rate);
            }
            self.tally.hear(&report);
        }
    }
}
