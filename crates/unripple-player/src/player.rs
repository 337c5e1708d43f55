//! The audio side of a player: computes blocks of samples from commands, in real time.

use crate::copies::Fade;
use crate::desk::Sent;
use crate::events::Events;
use crate::hold::Held;
use crate::leases::{Leases, LetGo};
use crate::origin::Whose;
use crate::outlet::Outlet;
use crate::schedule::Schedule;
use crate::shelf::Garbage;
use crate::standing::Standing;
use crate::waves::Waves;
use crate::{At, Command, Count, Desk, Meters, Options, PlayerError, Report, Why, kernels};
use rtrb::{Consumer, RingBuffer};
use std::sync::Arc;

/// Seconds of the fade with which a player ends when its desk is dropped: short, and without a click. With twice this value, it
/// sounds for as much longer.
const ABANDONED: f64 = 0.02;

/// The side of a player that runs on the audio thread: computes blocks of samples from commands. It never
/// allocates, frees, locks, waits or fails.
pub struct Player {
    block: usize,
    outputs: usize,
    clock: u64,
    commands: Consumer<Sent>,
    schedule: Schedule,
    leases: Leases,
    events: Events,
    waves: Option<Waves>,
    outlet: Outlet,
    standing: Arc<Standing>,
    /// The fade with which everything ends, once that is asked for.
    ending: Option<Fade>,
    /// Samples of the fade if the desk was dropped.
    abandoned: u32,
}

impl std::fmt::Debug for Player {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { outputs, block, clock, .. } = self;
        write!(f, "Player {{ outputs: {outputs}, block: {block}, clock: {clock} }}")
    }
}

/// Makes a player, and the desk that controls it.
///
/// ```
/// use std::sync::Arc;
/// use unripple_player::{At, Command, Options, PreparedDrive, Voice, player};
///
/// let options = Options { outputs: 1, ..Options::default() };
/// let (mut player, mut desk) = player(&options)?;
/// let drive = Arc::new(PreparedDrive::new(1, vec![0.25, 0.5])?);
/// let start = Command::Start { voice: Voice(1), drive, at: At::Sample(3), gain: 1.0, period: None };
/// assert!(desk.send(start).is_ok());
/// let mut block = [0.0; 64];
/// player.process(&mut block);
/// assert_eq!(block[2..6], [0.0, 0.25, 0.5, 0.0]);
/// # Ok::<(), unripple_player::PlayerError>(())
/// ```
///
/// # Errors
/// [`PlayerError`] for options that [`Options::check`] refuses.
pub fn player(options: &Options) -> Result<(Player, Desk), PlayerError> {
    options.check()?;
    let meters = Arc::new(Meters::new(options.outputs));
    let standing = Arc::new(Standing::default());
    let (to_player, commands) = RingBuffer::new(options.commands);
    let (reports, from_reports) = RingBuffer::new(4 * options.commands + 4 * options.copies);
    let inputs = options.waves.map_or(0, |waves| waves.inputs);
    let feed = options.waves.map_or(0, |waves| waves.feed);
    let (feeds, from_feeds) = (0..inputs).map(|_| RingBuffer::new(feed)).unzip();
    let waves = options.waves.map(|waves| Waves::new(options, waves, from_feeds)).transpose()?;
    // In a block, all that is held may be let go and as much be begun anew.
    let sounds = options.waves.map_or(0, |waves| waves.sounds);
    let leases = options.voices + options.copies + sounds + options.commands;
    // A command leaves up to three things: a waveform, its filters, and what holds it.
    let waves_hold = waves.as_ref().map_or(0, Waves::places);
    let held = 3 * options.commands + leases + Events::places(options) + waves_hold;
    let (garbage, from_garbage) = RingBuffer::new(2 * held);
    let desk = Desk {
        commands: to_player,
        sent: 0,
        reports: from_reports,
        garbage: from_garbage,
        feeds,
        plan: waves.as_ref().map(|waves| waves.convolver().plan().clone()),
        meters: meters.clone(),
        standing: standing.clone(),
        outputs: options.outputs,
        wave_delay: waves.as_ref().map_or(0, |waves| waves.convolver().delay() + options.block),
    };
    let player = Player {
        block: options.block,
        outputs: options.outputs,
        clock: 0,
        commands,
        schedule: Schedule::new(options.commands),
        leases: Leases::new(leases),
        events: Events::new(options),
        waves,
        outlet: Outlet::new(reports, garbage, held, meters),
        standing,
        ending: None,
        abandoned: (ABANDONED * options.rate) as u32,
    };
    Ok((player, desk))
}

impl Player {
    /// Computes the next block, planar (all samples of one output, then those of the next), in the
    /// actuators' unit. If the slice has a wrong size, it is filled with silence and counted, and the clock
    /// does not advance.
    pub fn process(&mut self, out: &mut [f32]) {
        out.fill(0.0);
        if out.len() != self.outputs * self.block {
            return self.outlet.meters.add(Count::Misfits);
        }
        if !self.standing.is_over() {
            self.render(out);
        }
        self.clock += self.block as u64;
        self.outlet.meters.set_clock(self.clock);
    }

    /// Fills a block of a player that is not over.
    fn render(&mut self, out: &mut [f32]) {
        if self.ending.is_none() {
            let gone = self.commands.is_abandoned().then_some(self.abandoned);
            let asked = self.standing.ending().or(gone);
            let fade = |length: u32| Fade { from: self.clock, length, level: 1.0 };
            self.ending = asked.map(|asked| fade(asked.max(self.block as u32)));
        }
        if let Some(waves) = &mut self.waves {
            waves.advance(&mut self.events.ledger);
        }
        if self.ending.is_none() {
            self.events.resume(self.clock, &mut self.outlet);
            self.take_commands();
            self.act();
        }
        let waves = self.waves.as_ref();
        self.events.mix(self.clock, out, |out| waves.into_iter().for_each(|waves| waves.fall(out)));
        if let Some(waves) = &mut self.waves {
            waves.render(self.clock, &mut self.outlet);
            waves.mix(self.clock, &self.events.ledger, out, &mut self.outlet);
        }
        self.fade(out);
        self.events.settle(self.clock, out, &mut self.outlet);
        for (output, samples) in out.chunks_exact(self.block).enumerate() {
            self.outlet.meters.raise_peak(output, kernels::peak(samples));
            self.outlet.meters.set_heat(output, self.events.ledger.powers().used(output));
        }
        let (events, waves) = (&self.events, self.waves.as_ref());
        let is_on = |id: u64| events.holds(id) || waves.is_some_and(|waves| waves.holds(id));
        self.leases.settle(self.clock + self.block as u64, is_on, &mut self.outlet);
        let silent = self.is_silent(out);
        self.outlet.meters.set_silent(silent);
        if self.ending.is_some_and(|fade| silent || fade.end() <= self.clock + self.block as u64) {
            self.outlet.meters.set_silent(true);
            self.standing.set_over();
        }
    }

    /// Applies the final fade. Lower samples stay within the limits.
    fn fade(&self, out: &mut [f32]) {
        let Some(fade) = self.ending else { return };
        for channel in out.chunks_exact_mut(self.block) {
            for (x, sample) in channel.iter_mut().zip(self.clock..) {
                *x *= fade.weight(sample);
            }
        }
    }

    /// Whether nothing sounds in this block and nothing is to come.
    fn is_silent(&self, out: &[f32]) -> bool {
        let idle = self.schedule.is_empty() && self.events.is_idle();
        idle && self.waves.as_ref().is_none_or(Waves::is_idle) && out.iter().all(|x| *x == 0.0)
    }

    /// Index of the first sample of the next block, on the player's clock.
    pub fn clock(&self) -> u64 {
        self.clock
    }

    /// The counters, which may be shared with any thread.
    pub fn meters(&self) -> &Arc<Meters> {
        &self.outlet.meters
    }

    /// Receives the commands that were sent before this block.
    fn take_commands(&mut self) {
        for _ in 0..self.commands.slots() {
            if !self.outlet.is_open() {
                return;
            }
            let Ok(sent) = self.commands.pop() else { return };
            let sample = match sent.command.at() {
                At::Now => self.clock,
                At::Sample(sample) => sample,
            };
            if let Err(sent) = self.schedule.push(sample, sent) {
                self.refuse(sent, Why::Pending);
            }
        }
    }

    /// Carries out what is due in this block, in the order of samples: first holds that were released, then commands,
    /// then repetitions.
    fn act(&mut self) {
        let end = self.clock + self.block as u64;
        let mut going = self.leases.next(end);
        loop {
            let command = self.schedule.next().map_or(u64::MAX, |sample| sample.max(self.clock));
            let repetition = self.events.next().unwrap_or((u64::MAX, 0));
            if let Some(go) = going.filter(|go| go.sample.max(self.clock) <= command.min(repetition.0)) {
                self.let_go(go);
                going = self.leases.next(end);
                continue;
            }
            if command.min(repetition.0) >= end {
                return;
            }
            if repetition.0 < command {
                self.events.repeat(repetition.1, &mut self.outlet);
            } else if let Some((sample, sent)) = self.schedule.pop() {
                if sample < self.clock {
                    let voice = sent.command.voice();
                    self.outlet.report(Report::Late { voice, by: self.clock - sample });
                }
                if self.begin(sample.max(self.clock), sent) {
                    going = self.leases.next(end);
                }
            }
        }
    }

    /// Ends what was begun under a hold that was released.
    fn let_go(&mut self, LetGo { id, sample, fade }: LetGo) {
        let sample = sample.max(self.clock);
        self.leases.let_go(id);
        self.events.stop(id, sample, fade, &mut self.outlet);
        if let Some(waves) = &mut self.waves {
            waves.stop(id, sample, fade);
        }
    }

    /// Carries out a command unless it was released or taken back; whether a hold was added.
    fn begin(&mut self, sample: u64, sent: Sent) -> bool {
        let let_go = sent.held.as_ref().is_some_and(|held| held.until() <= sample);
        if let_go || sent.command.is_passing() && sent.id <= self.standing.withdrawn() {
            self.refuse(sent, Why::Stale);
            return false;
        }
        let Some(held) = sent.held else {
            self.obey(sample, sent.id, sent.command);
            return false;
        };
        if self.leases.is_full() {
            self.refuse(Sent { held: Some(held), ..sent }, Why::Voices);
            return false;
        }
        let begun = self.obey(sample, sent.id, sent.command);
        if begun {
            self.leases.put(sent.id, held);
        } else {
            self.forget(held);
        }
        begun
    }

    /// Carries out a command; returns whether it began a drive or waveform.
    fn obey(&mut self, sample: u64, id: u64, command: Command) -> bool {
        let (events, outlet) = (&mut self.events, &mut self.outlet);
        match command {
            Command::Start { voice, drive, gain, period, .. } => {
                return events.start((Whose { voice, id }, drive), sample, (gain, period), outlet);
            }
            Command::Swap { voice, drive, .. } => events.swap(voice, drive, outlet),
            Command::Gain { voice, gain, .. } => events.gain(voice, gain, outlet),
            Command::SetFilters { input, filters, fade, .. } => match &mut self.waves {
                Some(waves) => waves.turn(input, filters, fade, outlet),
                None => {
                    outlet.discard(Garbage::Filters(filters));
                    outlet.refuse(None, Why::Input);
                }
            },
            Command::Wave { voice, input, filters, samples, gain, looped, .. } => match &mut self.waves {
                Some(waves) => {
                    let whose = Whose { voice, id };
                    return waves.start((whose, input), (samples, filters), sample, (gain, looped), outlet);
                }
                None => {
                    outlet.discard(Garbage::Samples(samples));
                    filters.into_iter().for_each(|(filters, _)| outlet.discard(Garbage::Filters(filters)));
                    outlet.refuse(Some(voice), Why::Input);
                }
            },
        }
        false
    }

    /// Refuses a command: reports why, and sends back what came with it.
    fn refuse(&mut self, sent: Sent, why: Why) {
        self.outlet.refuse(sent.command.voice(), why);
        if let Some(held) = sent.held {
            self.forget(held);
        }
        match sent.command {
            Command::Start { drive, .. } | Command::Swap { drive, .. } => {
                self.outlet.discard(Garbage::Drive(drive))
            }
            Command::SetFilters { filters, .. } => self.outlet.discard(Garbage::Filters(filters)),
            Command::Wave { samples, filters, .. } => {
                self.outlet.discard(Garbage::Samples(samples));
                filters.into_iter().for_each(|(filters, _)| self.outlet.discard(Garbage::Filters(filters)));
            }
            Command::Gain { .. } => {}
        }
    }

    /// Marks a hold as over whose drive or waveform never began.
    fn forget(&mut self, held: Arc<Held>) {
        held.set_over(self.clock);
        self.outlet.discard(Garbage::Held(held));
    }
}
