use crate::events::Events;
use crate::outlet::Outlet;
use crate::schedule::Schedule;
use crate::shelf::Garbage;
use crate::waves::Waves;
use crate::{At, Command, Count, Desk, Meters, Options, PlayerError, Report, Voice, Why, kernels};
use rtrb::{Consumer, RingBuffer};
use std::sync::Arc;

/// The end that lives on the audio thread: turns commands into blocks, and never allocates, frees, locks, waits or fails.
pub struct Player {
    block: usize,
    outputs: usize,
    clock: u64,
    commands: Consumer<Command>,
    schedule: Schedule,
    events: Events,
    waves: Option<Waves>,
    outlet: Outlet,
}

impl std::fmt::Debug for Player {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { outputs, block, clock, .. } = self;
        write!(f, "Player {{ outputs: {outputs}, block: {block}, clock: {clock} }}")
    }
}

/// A player and the desk that it is run from.
///
/// ```
/// use std::sync::Arc;
/// use unripple_player::{At, Command, Options, Prepared, Voice, player};
///
/// let options = Options { outputs: 1, ..Options::default() };
/// let (mut player, mut desk) = player(&options)?;
/// let drive = Arc::new(Prepared::new(1, vec![0.25, 0.5])?);
/// let start = Command::Start { voice: Voice(1), drive, at: At::Sample(3), gain: 1.0, period: None };
/// assert!(desk.send(start).is_ok());
/// let mut block = [0.0; 64];
/// player.process(&mut block);
/// assert_eq!(block[2..6], [0.0, 0.25, 0.5, 0.0]);
/// # Ok::<(), unripple_player::PlayerError>(())
/// ```
///
/// # Errors
/// [`PlayerError`] for options that cannot be.
pub fn player(options: &Options) -> Result<(Player, Desk), PlayerError> {
    options.check()?;
    let meters = Arc::new(Meters::new(options.outputs));
    let (to_player, commands) = RingBuffer::new(options.commands);
    let (reports, from_reports) = RingBuffer::new(4 * options.commands + 4 * options.copies);
    let inputs = options.waves.map_or(0, |waves| waves.inputs);
    let feed = options.waves.map_or(0, |waves| waves.feed);
    let (feeds, from_feeds) = (0..inputs).map(|_| RingBuffer::new(feed)).unzip();
    let waves = options.waves.map(|waves| Waves::new(options, waves, from_feeds)).transpose()?;
    let held = options.commands + Events::places(options) + waves.as_ref().map_or(0, Waves::places);
    let (garbage, from_garbage) = RingBuffer::new(2 * held);
    let desk = Desk {
        commands: to_player,
        reports: from_reports,
        garbage: from_garbage,
        feeds,
        plan: waves.as_ref().map(|waves| waves.convolver().plan().clone()),
        meters: meters.clone(),
        outputs: options.outputs,
        wave_delay: waves.as_ref().map_or(0, |waves| waves.convolver().delay() + options.block),
    };
    let player = Player {
        block: options.block,
        outputs: options.outputs,
        clock: 0,
        commands,
        schedule: Schedule::new(options.commands),
        events: Events::new(options),
        waves,
        outlet: Outlet::new(reports, garbage, held, meters),
    };
    Ok((player, desk))
}

impl Player {
    /// The next block: planar, output after output, in the actuators' unit. A slice of another size is filled with silence and
    /// counted; time stands still.
    pub fn process(&mut self, out: &mut [f32]) {
        out.fill(0.0);
        if out.len() != self.outputs * self.block {
            return self.outlet.meters.add(Count::Misfits);
        }
        if let Some(waves) = &mut self.waves {
            waves.advance(&mut self.events.ledger);
        }
        self.events.resume(self.clock, &mut self.outlet);
        self.take_commands();
        self.act();
        self.events.mix(self.clock, out);
        if let Some(waves) = &mut self.waves {
            waves.render(self.clock, &mut self.outlet);
            waves.mix(self.clock, &self.events.ledger, out, &mut self.outlet);
        }
        self.events.settle(self.clock, out, &mut self.outlet);
        for (output, samples) in out.chunks_exact(self.block).enumerate() {
            self.outlet.meters.raise_peak(output, kernels::peak(samples));
            self.outlet.meters.set_heat(output, self.events.ledger.powers().used(output));
        }
        self.clock += self.block as u64;
        self.outlet.meters.set_clock(self.clock);
    }

    /// First sample of the next block.
    pub fn clock(&self) -> u64 {
        self.clock
    }

    /// What is counted.
    pub fn meters(&self) -> &Arc<Meters> {
        &self.outlet.meters
    }

    /// Takes in what was sent before this block.
    fn take_commands(&mut self) {
        for _ in 0..self.commands.slots() {
            if !self.outlet.is_open() {
                return;
            }
            let Ok(command) = self.commands.pop() else { return };
            let sample = match command.at() {
                At::Now => self.clock,
                At::Sample(sample) => sample,
            };
            if let Err(command) = self.schedule.push(sample, command) {
                self.outlet.refuse(command.voice(), Why::Pending);
                self.discard(command);
            }
        }
    }

    /// Does all that is due in this block, in the order of samples; commands before repetitions.
    fn act(&mut self) {
        let end = self.clock + self.block as u64;
        loop {
            let command = self.schedule.next().map_or(u64::MAX, |sample| sample.max(self.clock));
            let repetition = self.events.next().unwrap_or((u64::MAX, 0));
            if command.min(repetition.0) >= end {
                return;
            }
            if repetition.0 < command {
                self.events.repeat(repetition.1, &mut self.outlet);
            } else if let Some((sample, command)) = self.schedule.pop() {
                if sample < self.clock {
                    let voice = command.voice();
                    self.outlet.report(Report::Late { voice, by: self.clock - sample });
                }
                self.obey(sample.max(self.clock), command);
            }
        }
    }

    fn obey(&mut self, sample: u64, command: Command) {
        let (events, outlet) = (&mut self.events, &mut self.outlet);
        match command {
            Command::Start { voice, drive, gain, period, .. } => {
                events.start((voice, drive), sample, (gain, period), outlet)
            }
            Command::Swap { voice, drive, .. } => events.swap(voice, drive, outlet),
            Command::Gain { voice, gain, .. } => events.gain(voice, gain, outlet),
            Command::Stop { voice, fade, .. } => {
                events.stop(voice, sample, fade, outlet);
                if let Some(waves) = &mut self.waves {
                    waves.stop(voice, sample, fade);
                }
            }
            Command::SetFilters { input, filters, fade, .. } => match &mut self.waves {
                Some(waves) => waves.turn(input, filters, fade, outlet),
                None => self.no_waves(None, Garbage::Filters(filters)),
            },
            Command::Wave { voice, input, samples, gain, looped, .. } => match &mut self.waves {
                Some(waves) => waves.start((voice, input), samples, sample, (gain, looped), outlet),
                None => self.no_waves(Some(voice), Garbage::Samples(samples)),
            },
        }
    }

    fn no_waves(&mut self, voice: Option<Voice>, garbage: Garbage) {
        self.outlet.discard(garbage);
        self.outlet.refuse(voice, Why::Input);
    }

    fn discard(&mut self, command: Command) {
        match command {
            Command::Start { drive, .. } | Command::Swap { drive, .. } => {
                self.outlet.discard(Garbage::Drive(drive))
            }
            Command::SetFilters { filters, .. } => self.outlet.discard(Garbage::Filters(filters)),
            Command::Wave { samples, .. } => self.outlet.discard(Garbage::Samples(samples)),
            Command::Gain { .. } | Command::Stop { .. } => {}
        }
    }
}
