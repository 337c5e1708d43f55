//! From touches to commands for the player: starts, moves and stops of effects.

use crate::log::{Began, Log};
use crate::pace::Pace;
use crate::pulses::Ahead;
use crate::sounding::{Inputs, Kept, Sounding};
use crate::waiting::Waiting;
use crate::{DriveCache, FocusWorker, LiveError, PlayStats, Timeline, Timing};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};
use unripple_effects::{Act, Cue, Effects};
use unripple_player::{At, Command, Count, Desk, Prepared, Report, Voice};
use unripple_touch::{Heard, Wish};

/// Starts whose touches are remembered until the player reports them; the oldest go first, and their latency is not
/// counted.
const MOST_ASKED: usize = 1 << 12;

/// Time after which a step that makes drives looks at what came meanwhile, so that a finger that lifts is not kept waiting.
const LONG: Duration = Duration::from_millis(5);

/// The player's name of pings: the last of all numbers, which no start is given.
const PING: u64 = u64::MAX;

/// Turns what touches set off into commands for a player: cues wait here for their time, drives are made or remembered, and what
/// sounds follows the finger.
///
/// A focus comes a window after its drive begins. So what is known ahead, as in a score, begins a window early; what a touch sets off
/// begins at once.
///
/// Deterministic: the same touches at the same samples give the same commands, as long as the player's clock moves.
///
/// # Nothing sounds that nobody wants
///
/// What is over by itself, a pulse or a waveform played once, may be lost; a stop takes back what was given ahead and has not begun. What goes on is held: the player ends it once the
/// [`Hold`](unripple_player::Hold) is stopped or dropped, and here a hold lives in the entry of its voice and nowhere else. So what
/// is forgotten here ends there, and a stop needs no room, neither on the way nor in the player.
///
/// - The way is full: the command comes back. Pulses are lost and counted; of what goes on the entry stays and is sent again with the
///   next block, by when it may have moved or be gone.
/// - The player refuses, or something is over: the hold says so, the entry goes, and the input of a waveform is free. What goes on and
///   found no room stays and is begun again after a while. A change that was refused is sent again. Reports only measure; if some were lost, all that goes on is sent again.
/// - Drives take long to make: a stop ends what sounds at once, whatever is still to be made, and takes back what its voice waits for.
///   Where threads play, a step makes drives for a few milliseconds only and leaves the rest to the next, so that it hears of the stop.
///   A pulse whose turn comes too late is not begun.
/// - The player stands still: after a tenth of a second what was sent to it and would be over by itself is taken back, and nothing more is
///   sent before it goes on. Fingers are followed meanwhile, and what they then still hold is sent.
/// - This side is gone: the player fades out by itself. [`Conductor::end`] asks it to.
pub struct Conductor {
    effects: Effects,
    pub(crate) drives: DriveCache,
    pub(crate) desk: Desk,
    pub(crate) rate: f64,
    /// Samples from the beginning of a drive to its focus.
    pub(crate) lead: u64,
    pub(crate) waiting: BTreeMap<(u64, u64), Waiting>,
    pub(crate) order: u64,
    /// The last of those that waited when the present step began.
    pub(crate) old: u64,
    /// Whether there had been no time for some of them.
    pub(crate) late: bool,
    pub(crate) sounding: BTreeMap<u64, Kept>,
    pub(crate) inputs: Inputs,
    pub(crate) ahead: Ahead,
    /// Names given to the player so far.
    names: u64,
    /// Factor on all levels.
    pub(crate) trim: f64,
    /// When the touch came that a start answers, in samples, by its name.
    asked: BTreeMap<u64, u64>,
    cues: Vec<Cue>,
    pub(crate) tally: PlayStats,
    pace: Pace,
    /// Whether the player stands still.
    pub(crate) stands: bool,
    /// The block in which the player was last sent what it may not know.
    told: Option<u64>,
    /// Reports lost so far.
    missed: u64,
    /// What each voice plays, and what of it has begun, while somebody wants to know.
    log: Option<Log>,
    ended: bool,
    /// When samples leave, while a device plays by a clock of its own.
    timeline: Option<Arc<Timeline>>,
}

impl std::fmt::Debug for Conductor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Conductor").field("waiting", &self.waiting.len()).field("tally", &self.tally).finish()
    }
}

impl Conductor {
    /// Effects played through a desk, whose player has `inputs` inputs for waveforms; `time` has its rate, block and
    /// window.
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
            names: 0,
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

    /// Lets drives be made with real-time priority, 1 to 99, where the system grants it.
    pub fn request_realtime(&mut self, priority: Option<u8>) {
        self.drives.request_realtime(priority);
    }

    /// Counts latency by when samples leave, from now on.
    pub(crate) fn count_by(&mut self, timeline: Arc<Timeline>) {
        self.timeline = Some(timeline);
    }

    /// Whether nothing sounds and nothing waits: nothing is to be done then before somebody touches.
    pub(crate) fn rests(&self) -> bool {
        let silent = self.sounding.is_empty() && self.inputs.rest();
        silent && self.waiting.is_empty() && self.effects.rests()
    }

    /// Plays a drive that asks the sheet for its tension, at once.
    pub(crate) fn ping(&mut self, drive: Arc<Prepared>) {
        if !self.ended && !self.stands {
            self.send(Command::Start { voice: Voice(PING), drive, at: At::Now, gain: 1.0, period: None });
        }
    }

    /// Ends it all: what sounds fades out over so many seconds, what waits is dropped, and later touches set nothing off.
    pub fn end(&mut self, fade: f64) {
        self.ended = true;
        self.waiting.clear();
        self.desk.end((fade * self.rate).round() as u32);
    }

    /// Whether all has faded out after [`Conductor::end`]; never said by a player that is not asked for blocks any more.
    pub fn is_over(&self) -> bool {
        self.desk.is_over()
    }

    /// Keeps, from now on, which drives begin, for [`Conductor::began`].
    pub fn keep_log(&mut self) {
        self.log = Some(Log::default());
    }

    /// Drives that began since this was last asked, as far as the player has reported: what began in a block is
    /// reported after it.
    pub fn began(&mut self) -> Vec<Began> {
        self.listen();
        self.log.as_mut().map_or_else(Vec::new, Log::take)
    }

    /// Counts of what was played and what was not, and latencies.
    pub fn tally(&self) -> &PlayStats {
        &self.tally
    }

    /// The player's other end.
    pub fn desk(&self) -> &Desk {
        &self.desk
    }

    /// Drives made so far, and those remembered.
    pub fn drives(&self) -> &DriveCache {
        &self.drives
    }

    /// Takes in touches and wishes, and gives the player all that begins before `until`, both in samples of the
    /// player's clock; `now` is the first sample of the next block. Touches carry the same clock in s.
    ///
    /// # Errors
    /// [`LiveError::Gone`] if no drive can be made any more; what fails for one cue is counted.
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

    /// Whether a step has taken so long that what came meanwhile is looked at first; never where nothing comes meanwhile.
    pub(crate) fn is_long(&self, began: Instant) -> bool {
        self.timeline.is_some() && began.elapsed() > LONG
    }

    /// Whether something waits that would have begun before a sample had there been time.
    pub(crate) fn is_behind(&self, until: u64) -> bool {
        self.waiting.first_key_value().is_some_and(|((at, _), _)| *at < until)
    }

    /// A fade of so many seconds in samples; without any, drives that have begun ring out.
    pub(crate) fn fade(&self, seconds: f64) -> Option<u32> {
        Some((seconds * self.rate).round() as u32).filter(|samples| *samples > 0)
    }

    /// Goes on with another maker: what sounds goes over to drives for the surface as it is now. `now` is a sample of
    /// the player's clock.
    ///
    /// # Errors
    /// [`LiveError::Gone`] if no drive can be made any more.
    pub fn renew(&mut self, maker: FocusWorker, now: u64) -> Result<(), LiveError> {
        self.drives.replace(maker);
        self.sounding.values_mut().for_each(|kept| kept.told = false);
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
                self.keep(cue.voice, Sounding::Comb { place: *place, level: *gain, period }, asked, at)
            }
            Act::Wave { place, wave, gain, looped, fade } => {
                let (place, level, wave) = (*place, *gain, wave.clone());
                let wave = Sounding::Wave { place, level, wave, looped: *looped, fade: *fade };
                self.keep(cue.voice, wave, asked, at)
            }
            Act::Move { place } => self.change(cue.voice, |sounding| sounding.moved(*place), at),
            Act::Gain { gain } => self.change(cue.voice, |sounding| sounding.at_level(*gain), at),
            Act::Stop { fade } => {
                self.ahead.take_back(cue.voice);
                self.let_go(cue.voice, self.fade(*fade), at);
                Ok(())
            }
        }
    }

    /// A name that the player does not know yet, for what answers a touch that came at a sample.
    pub(crate) fn name(&mut self, asked: Option<u64>) -> u64 {
        self.names += 1;
        if let Some(asked) = asked {
            self.asked.insert(self.names, asked);
            if self.asked.len() > MOST_ASKED {
                self.asked.pop_first();
            }
        }
        self.names
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

    /// The first sample that leaves of what begins at one: waveforms pass filters first.
    fn leaves(&self, voice: Voice, sample: u64) -> u64 {
        let waves = self.sounding.values().any(|kept| kept.name == voice.0 && kept.input.is_some());
        sample + if waves { self.desk.wave_delay() as u64 } else { 0 }
    }

    /// Seconds from a touch, timed by a sample, to another sample.
    fn late(&self, asked: u64, sample: u64) -> f64 {
        let plain = || sample.saturating_sub(asked) as f64 / self.rate;
        self.timeline.as_ref().map_or_else(plain, |timeline| timeline.between(asked, sample))
    }

    /// Hears what the player says.
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
                    // Filters have no name: those of any waveform may be meant.
                    let meant =
                        |kept: &&mut Kept| voice.map_or(kept.input.is_some(), |voice| voice.0 == kept.name);
                    let hopeless = voice.is_some() && !why.may_pass();
                    for kept in self.sounding.values_mut().filter(meant) {
                        kept.told = false;
                        kept.hopeless |=
                            hopeless && kept.hold.as_ref().is_some_and(|hold| hold.over().is_some());
                    }
                }
                _ => {}
            }
        }
        let missed = self.desk.meters().count(Count::ReportsLost);
        if std::mem::replace(&mut self.missed, missed) != missed {
            self.asked.clear();
            self.log.iter_mut().for_each(Log::miss);
            self.sounding.values_mut().for_each(|kept| kept.told = false);
        }
    }
}
