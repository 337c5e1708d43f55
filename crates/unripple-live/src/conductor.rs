//! From touches to commands for the player: starts, moves and stops of effects.

use crate::log::{Began, Log};
use crate::pace::Pace;
use crate::pulses::Ahead;
use crate::voice_state::{Inputs, SustainedSound, VoiceState};
use crate::waiting::Waiting;
use crate::{DriveCache, FocusWorker, LiveError, PlayStats, Timeline, Timing};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;
use unripple_core::clock::Instant;
use unripple_effects::{Act, Cue, Effects};
use unripple_player::{At, Command, Count, Desk, PreparedDrive, Report, Voice};
use unripple_touch::{Heard, Wish};

/// Starts whose touches are remembered until the player reports them; the oldest go first, and their latency is not
/// counted.
const MOST_ASKED: usize = 1 << 12;

/// Time after which a step that makes drives looks at what came meanwhile, so that a finger that lifts is not kept waiting.
const LONG: Duration = Duration::from_millis(5);

/// The player's voice number for pings: the largest number, which no other start is given.
const PING: u64 = u64::MAX;

/// Turns touches into commands for a player. Effects turn touches into cues, which wait here for their time; drives
/// are computed or taken from a cache; sustained sounds follow the finger.
///
/// A focus comes one window after its drive begins. So the drive of an event known ahead, as in a score, begins one
/// window early; that of a touch begins at once.
///
/// Deterministic: the same touches at the same samples give the same commands, as long as the player's clock moves.
///
/// # Every sound ends
///
/// Pulses, and waveforms played once, end by themselves. Their commands may be lost; a stop withdraws those that were
/// sent ahead and have not begun. Sustained sounds (repeated foci and looped waveforms) are held: the player ends one
/// once its [`Hold`](unripple_player::Hold) is stopped or dropped, and the hold is stored only in the entry of its
/// voice here. So a sound whose entry is removed ends, and a stop needs no room in the queue or in the player.
///
/// - The queue to the player is full: the command comes back. Pulses are lost and counted. A sustained sound keeps
///   its entry, and its command is sent again with the next block, unless it has been moved or stopped meanwhile.
/// - The player refuses a command, or a sound is over: the hold says so, the entry is removed, and the input of a
///   waveform is free again. A sustained sound that found no room keeps its entry and is begun again after 20 ms. A
///   refused change is sent again. Reports only serve statistics; if some were lost, all sustained sounds are sent
///   again.
/// - Drives take long to compute: a stop ends the sound at once, whatever is still to be computed, and removes the
///   waiting cues of its voice. When threads play, a step computes drives for 5 ms only and leaves the rest to the
///   next step, so that it notices a stop. A pulse that would begin more than 0.1 s late is not begun.
/// - The player stands still: after 0.1 s, commands of sounds that end by themselves are withdrawn, and nothing is
///   sent before it continues. Fingers are followed meanwhile; what they hold then is sent.
/// - This side ends: the player fades out by itself. [`Conductor::end`] requests it.
pub struct Conductor {
    effects: Effects,
    pub(crate) drives: DriveCache,
    pub(crate) desk: Desk,
    pub(crate) rate: f64,
    /// Samples from the beginning of a drive to its focus.
    pub(crate) lead: u64,
    pub(crate) waiting: BTreeMap<(u64, u64), Waiting>,
    pub(crate) order: u64,
    /// Number of the last cue that was waiting when this step began.
    pub(crate) old: u64,
    /// Whether some of these cues were due already: there had been no time for them.
    pub(crate) late: bool,
    pub(crate) sounding: BTreeMap<u64, VoiceState>,
    pub(crate) inputs: Inputs,
    pub(crate) ahead: Ahead,
    /// Number of voice numbers given to the player so far.
    player_voices: u64,
    /// Factor on all levels.
    pub(crate) trim: f64,
    /// Time of the touch that a start answers, in samples, by the player's voice number of the start.
    asked: BTreeMap<u64, u64>,
    cues: Vec<Cue>,
    pub(crate) tally: PlayStats,
    pace: Pace,
    /// Whether the player stands still.
    pub(crate) stands: bool,
    /// First sample of the block in which the sounds that the player may not know were last sent to it.
    told: Option<u64>,
    /// Reports lost so far.
    missed: u64,
    /// Log of the drives that begin, if it is kept.
    log: Option<Log>,
    ended: bool,
    /// Times at which samples leave the device, when threads play.
    timeline: Option<Arc<Timeline>>,
}

impl std::fmt::Debug for Conductor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Conductor").field("waiting", &self.waiting.len()).field("tally", &self.tally).finish()
    }
}

impl Conductor {
    /// A conductor that plays effects through a desk, whose player has `inputs` inputs for waveforms; `time` has the
    /// rate, block and window.
    pub fn new(effects: Effects, drives: DriveCache, desk: Desk, time: Timing, inputs: usize) -> Self {
        let Timing { rate, window, .. } = time;
        Self {
            effects,
            drives,
            desk,
            rate,
            lead: (window * rate).round() as u64,
            waiting: BTreeMap::new(),
            order: 0,
            old: 0,
            late: false,
            sounding: BTreeMap::new(),
            inputs: Inputs::new(inputs),
            ahead: Ahead::default(),
            player_voices: 0,
            trim: 1.0,
            asked: BTreeMap::new(),
            cues: Vec::new(),
            tally: PlayStats::default(),
            pace: Pace::new(rate),
            stands: false,
            told: None,
            missed: 0,
            log: None,
            ended: false,
            timeline: None,
        }
    }

    /// Requests real-time priority, 1 to 99, for the thread that computes drives; `None` requests nothing.
    pub fn request_realtime(&mut self, priority: Option<u8>) {
        self.drives.request_realtime(priority);
    }

    /// From now on measures latency by the times at which samples leave the device.
    pub(crate) fn count_by(&mut self, timeline: Arc<Timeline>) {
        self.timeline = Some(timeline);
    }

    /// Whether nothing sounds and nothing waits, so that nothing is to be done before the next touch.
    pub(crate) fn rests(&self) -> bool {
        let silent = self.sounding.is_empty() && self.inputs.rest();
        silent && self.waiting.is_empty() && self.effects.rests()
    }

    /// Plays a test signal that measures the tension of the sheet, at once.
    pub(crate) fn ping(&mut self, drive: Arc<PreparedDrive>) {
        if !self.ended && !self.stands {
            self.send(Command::Start { voice: Voice(PING), drive, at: At::Now, gain: 1.0, period: None });
        }
    }

    /// Ends playing: sounds fade out over `fade` s, waiting cues are dropped, and later touches have no effect.
    pub fn end(&mut self, fade: f64) {
        self.ended = true;
        self.waiting.clear();
        self.desk.end((fade * self.rate).round() as u32);
    }

    /// Whether everything has faded out after [`Conductor::end`]. Stays false if no further blocks of the
    /// player are computed.
    pub fn is_over(&self) -> bool {
        self.desk.is_over()
    }

    /// Starts a log of the drives that begin, for [`Conductor::began`].
    pub fn keep_log(&mut self) {
        self.log = Some(Log::default());
    }

    /// Drives that began since the last call, as far as the player has reported: it reports after each block. Empty
    /// without [`Conductor::keep_log`].
    pub fn began(&mut self) -> Vec<Began> {
        self.listen();
        self.log.as_mut().map_or_else(Vec::new, Log::take)
    }

    /// Counts of what was played and what was not, and latencies.
    pub fn tally(&self) -> &PlayStats {
        &self.tally
    }

    /// The desk, through which commands are sent to the player.
    pub fn desk(&self) -> &Desk {
        &self.desk
    }

    /// The cache of drives, with the times that it took to compute them.
    pub fn drives(&self) -> &DriveCache {
        &self.drives
    }

    /// Processes touches and requests, and sends the player the commands for all that begins before `until`. `now`,
    /// the first sample of the next block, and `until` are in samples of the player's clock; touches carry the same
    /// clock in s.
    ///
    /// # Errors
    /// [`LiveError::Gone`] if the thread that computes drives is gone. The failure of a single cue is only counted.
    pub fn step(&mut self, heard: &Heard, now: u64, until: u64) -> Result<(), LiveError> {
        self.listen();
        if self.ended {
            return Ok(());
        }
        let stood = std::mem::replace(&mut self.stands, self.pace.stands(now, Instant::now()));
        if self.stands && !stood {
            self.desk.withdraw();
        }
        self.forget_over();
        (self.old, self.late) = (self.order, self.is_behind(now));
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
        let began = Instant::now();
        if self.told.replace(now) != Some(now) && !self.tell_again(At::Now, began)? {
            self.told = None;
        }
        while let Some(entry) = self.waiting.first_entry().filter(|entry| entry.key().0 < until) {
            let ((sample, _), Waiting { cue, asked }) = entry.remove_entry();
            let played = self.play(&cue, asked, sample, now);
            self.tally.cues += u64::from(self.tally.record(played)?);
            if self.is_long(began) {
                break;
            }
        }
        Ok(())
    }

    /// Whether a step has taken so long that it must end, so that new touches are looked at; never when no threads
    /// play.
    pub(crate) fn is_long(&self, began: Instant) -> bool {
        self.timeline.is_some() && began.elapsed() > LONG
    }

    /// Whether a cue waits that should have begun before a sample.
    pub(crate) fn is_behind(&self, until: u64) -> bool {
        self.waiting.first_key_value().is_some_and(|((at, _), _)| *at < until)
    }

    /// A fade in samples, from one in s; none for 0, so that drives that have begun ring out.
    pub(crate) fn fade(&self, seconds: f64) -> Option<u32> {
        Some((seconds * self.rate).round() as u32).filter(|samples| *samples > 0)
    }

    /// Continues with another worker that computes drives, after the surface has changed. Sustained sounds
    /// change to its drives from `now` on, a sample of the player's clock.
    ///
    /// # Errors
    /// [`LiveError::Gone`] if the thread that computes drives is gone.
    pub fn renew(&mut self, maker: FocusWorker, now: u64) -> Result<(), LiveError> {
        self.drives.replace(maker);
        self.sounding.values_mut().for_each(|state| state.told = false);
        if !self.tell_again(At::Sample(now), Instant::now())? {
            self.told = None;
        }
        Ok(())
    }

    /// The sample nearest to a time in s.
    pub(crate) fn sample(&self, time: f64) -> u64 {
        (time * self.rate).round().max(0.0) as u64
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

    fn play(&mut self, cue: &Cue, asked: Option<u64>, sample: u64, now: u64) -> Result<(), LiveError> {
        let at = if sample <= now { At::Now } else { At::Sample(sample) };
        match &cue.act {
            Act::Pulse { place, gain } => self.pulse(cue.voice, (&[*place], *gain), asked, (sample, at)),
            Act::Shape { points, gain } => self.pulse(cue.voice, (points, *gain), asked, (sample, at)),
            Act::Comb { place, rate, gain } => {
                let period = (self.rate / rate).round();
                self.keep(cue.voice, SustainedSound::Comb { place: *place, level: *gain, period }, asked, at)
            }
            Act::Wave { place, wave, gain, looped, fade } => {
                let (place, level, wave) = (*place, *gain, wave.clone());
                let wave = SustainedSound::Wave { place, level, wave, looped: *looped, fade: *fade };
                self.keep(cue.voice, wave, asked, at)
            }
            Act::Move { place } => self.change(cue.voice, |sound| sound.moved(*place), at),
            Act::Gain { gain } => self.change(cue.voice, |sound| sound.at_level(*gain), at),
            Act::Stop { fade } => {
                self.ahead.take_back(cue.voice);
                self.let_go(cue.voice, self.fade(*fade), at);
                Ok(())
            }
        }
    }

    /// A new voice number for the player. `asked` is the time of the touch that is answered, in samples.
    pub(crate) fn new_player_voice(&mut self, asked: Option<u64>) -> u64 {
        self.player_voices += 1;
        if let Some(asked) = asked {
            self.asked.insert(self.player_voices, asked);
            if self.asked.len() > MOST_ASKED {
                self.asked.pop_first();
            }
        }
        self.player_voices
    }

    /// Sends a command; whether there was room.
    pub(crate) fn send(&mut self, command: Command) -> bool {
        self.note(&command);
        let sent = self.desk.send(command).is_ok();
        self.tally.lost += u64::from(!sent);
        sent
    }

    pub(crate) fn note(&mut self, command: &Command) {
        if let Some(log) = &mut self.log {
            log.send(command, self.desk.clock());
        }
    }

    /// First sample of the drive that is due to a voice that begins at `sample`: filters delay waveforms.
    fn leaves(&self, voice: Voice, sample: u64) -> u64 {
        let waves =
            self.sounding.values().any(|state| state.player_voice == voice.0 && state.input.is_some());
        sample + if waves { self.desk.wave_delay() as u64 } else { 0 }
    }

    /// Seconds from a touch, timed by a sample, to another sample.
    fn late(&self, asked: u64, sample: u64) -> f64 {
        let plain = || sample.saturating_sub(asked) as f64 / self.rate;
        self.timeline.as_ref().map_or_else(plain, |timeline| timeline.between(asked, sample))
    }

    /// Reads the reports of the player.
    fn listen(&mut self) {
        while let Some(report) = self.desk.report() {
            if let Some(log) = &mut self.log {
                log.hear(&report);
            }
            if !self.ahead.meant(&report) {
                self.tally.hear(&report);
            }
            match report {
                Report::Started { voice, sample, .. } => {
                    let Some(asked) = self.asked.remove(&voice.0) else { continue };
                    let late = self.late(asked, self.leaves(voice, sample));
                    self.tally.first_sample.add(late);
                    self.tally.focus.add(late + self.lead as f64 / self.rate);
                }
                Report::Refused { voice, why } => {
                    voice.map(|voice| self.asked.remove(&voice.0));
                    // Filters have no voice number: those of any waveform may be meant.
                    let meant = |state: &&mut VoiceState| {
                        voice.map_or(state.input.is_some(), |voice| voice.0 == state.player_voice)
                    };
                    let hopeless = voice.is_some() && !why.may_pass();
                    for state in self.sounding.values_mut().filter(meant) {
                        state.told = false;
                        state.hopeless |=
                            hopeless && state.hold.as_ref().is_some_and(|hold| hold.over().is_some());
                    }
                }
                _ => {}
            }
        }
        let missed = self.desk.meters().count(Count::ReportsLost);
        if std::mem::replace(&mut self.missed, missed) != missed {
            self.asked.clear();
            self.log.iter_mut().for_each(Log::miss);
            self.sounding.values_mut().for_each(|state| state.told = false);
        }
    }
}
