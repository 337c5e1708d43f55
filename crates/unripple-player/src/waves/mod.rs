//! Continuous waveforms in the player: inputs of the convolver, and the gain of its outputs.

mod level;

use crate::copies::Fade;
use crate::error::HUGE;
use crate::kernels::Wide;
use crate::ledger::Ledger;
use crate::origin::Whose;
use crate::outlet::Outlet;
use crate::shelf::{Garbage, Shelf};
use crate::{Convolver, Options, PlayerError, PreparedFilters, Report, WaveOptions, Why};
use level::Level;
use pulp::Arch;
use rtrb::Consumer;
use std::sync::Arc;

/// Inputs, convolver and level of the waveforms.
pub(crate) struct Waves {
    options: WaveOptions,
    block: usize,
    convolver: Convolver,
    feeds: Vec<Consumer<f32>>,
    shelf: Shelf<[f32]>,
    sounds: Vec<Sound>,
    entering: Vec<f32>,
    /// Outputs of the convolver for this block and, a block ahead, for the next; planar.
    now: Vec<f32>,
    next: Vec<f32>,
    level: Level,
    /// Blocks since something entered.
    quiet: usize,
    arch: Arch,
}

/// Filters, and samples of the fade to them.
type Turn = (Arc<PreparedFilters>, u32);

/// A prepared waveform that enters an input.
struct Sound {
    whose: Whose,
    input: usize,
    /// Whether the input's filters came with this waveform.
    own: bool,
    samples: usize,
    start: u64,
    gain: f32,
    looped: bool,
    fade: Option<Fade>,
}

impl Waves {
    /// Nothing that sounds yet; `feeds` are the rings of samples, one per input.
    pub(crate) fn new(
        options: &Options,
        waves: WaveOptions,
        feeds: Vec<Consumer<f32>>,
    ) -> Result<Self, PlayerError> {
        let (outputs, block) = (options.outputs, options.block);
        let sizes = [waves.inputs, outputs];
        Ok(Self {
            convolver: Convolver::new(sizes, block, options.rate, waves.taps, waves.band_top_hz)?,
            feeds,
            shelf: Shelf::new(waves.sounds),
            sounds: Vec::with_capacity(waves.sounds),
            entering: vec![0.0; waves.inputs * block],
            now: vec![0.0; outputs * block],
            next: vec![0.0; outputs * block],
            level: Level::new(options),
            quiet: usize::MAX,
            arch: Arch::new(),
            options: waves,
            block,
        })
    }

    /// The convolver of the inputs.
    pub(crate) fn convolver(&self) -> &Convolver {
        &self.convolver
    }

    /// Largest number of shared data that may be held at once.
    pub(crate) fn places(&self) -> usize {
        self.convolver.places() + self.options.sounds
    }

    /// Whether nothing enters and the responses to all that did have ended, in this block and the next.
    pub(crate) fn is_idle(&self) -> bool {
        self.sounds.is_empty() && self.quiet > self.convolver.memory() + 1
    }

    /// Begins a block: keeps in the ledger what the waveforms need of it even if they are to fall as fast as they may.
    pub(crate) fn advance(&mut self, ledger: &mut Ledger) {
        std::mem::swap(&mut self.now, &mut self.next);
        if self.is_idle() {
            return;
        }
        let (level, now) = (&mut self.level, &self.now);
        self.arch.dispatch(Wide(
            #[inline(always)]
            || level.reserve(now, ledger),
        ));
    }

    /// Cross-fades an input, by its index, to other filters over `fade` samples.
    pub(crate) fn turn(
        &mut self,
        input: usize,
        filters: Arc<PreparedFilters>,
        fade: u32,
        outlet: &mut Outlet,
    ) {
        if input >= self.options.inputs {
            outlet.discard(Garbage::Filters(filters));
            return outlet.refuse(None, Why::Input);
        }
        if !self.fits(&filters) {
            outlet.discard(Garbage::Filters(filters));
            return outlet.refuse(None, Why::Outputs);
        }
        let blocks = fade.div_ceil(self.block as u32);
        if let Some(unused) = self.convolver.turn(input, filters, blocks) {
            outlet.discard(Garbage::Filters(unused));
        }
    }

    /// Starts a waveform at a sample of the clock, through new filters if there are some; returns whether it
    /// has been accepted.
    pub(crate) fn start(
        &mut self,
        (whose, input): (Whose, usize),
        (samples, filters): (Arc<[f32]>, Option<Turn>),
        start: u64,
        (gain, looped): (f32, bool),
        outlet: &mut Outlet,
    ) -> bool {
        let refused = match () {
            () if input >= self.options.inputs => Some(Why::Input),
            () if samples.is_empty() => Some(Why::Samples),
            () if !gain.is_finite() => Some(Why::Gain),
            () if filters.as_ref().is_some_and(|(filters, _)| !self.fits(filters)) => Some(Why::Outputs),
            () => None,
        };
        let placed = match refused {
            Some(why) => Err((why, samples)),
            None => self.shelf.put(samples).map_err(|samples| (Why::Copies, samples)),
        };
        match placed {
            Ok(samples) => {
                let (own, fade) = (filters.is_some(), None);
                if let Some((filters, fade)) = filters {
                    self.turn(input, filters, fade, outlet);
                }
                self.sounds.push(Sound { whose, input, own, samples, start, gain, looped, fade });
                outlet.report(Report::Started { voice: whose.voice, sample: start, gain });
                true
            }
            Err((why, samples)) => {
                outlet.discard(Garbage::Samples(samples));
                filters.into_iter().for_each(|(filters, _)| outlet.discard(Garbage::Filters(filters)));
                outlet.refuse(Some(whose.voice), why);
                false
            }
        }
    }

    fn fits(&self, filters: &PreparedFilters) -> bool {
        filters.shape == self.convolver.plan().shape()
    }

    /// Fades out what the command of number `id` began, from a sample on over `fade` samples.
    pub(crate) fn stop(&mut self, id: u64, sample: u64, fade: Option<u32>) {
        let length = fade.unwrap_or(0).max(self.block as u32);
        for sound in self.sounds.iter_mut().filter(|sound| sound.whose.id == id) {
            let from = if sound.fade.is_some() { sample - sample % self.block as u64 } else { sample };
            sound.fade = Some(Fade::after(sound.fade, from, length));
        }
    }

    /// Convolves what enters in the block that begins at sample `clock`.
    pub(crate) fn render(&mut self, clock: u64, outlet: &mut Outlet) {
        for (feed, entering) in self.feeds.iter_mut().zip(self.entering.chunks_exact_mut(self.block)) {
            entering.iter_mut().for_each(|to| *to = feed.pop().map_or(0.0, playable));
        }
        (0..self.sounds.len()).for_each(|at| self.enter(at, clock));
        let silent = self.entering.iter().all(|x| *x == 0.0);
        self.quiet = if silent { self.quiet.saturating_add(1) } else { 0 };
        if self.is_idle() && !self.convolver.is_turning() {
            // Silence through whatever filters is silence.
            return self.next.fill(0.0);
        }
        let leave = |garbage| outlet.discard(garbage);
        self.convolver.process_leaving(&self.entering, &mut self.next, leave);
        self.settle(clock, outlet);
    }

    /// Ends waveforms of which nothing is still to enter the convolver. Filters that came with one go with it: what comes next through the
    /// input begins from silence.
    fn settle(&mut self, clock: u64, outlet: &mut Outlet) {
        let entered = clock + self.block as u64;
        let mut at = 0;
        while at < self.sounds.len() {
            let end = self.end(at);
            if end.saturating_add(self.convolver.lag() as u64) > entered {
                at += 1;
                continue;
            }
            let over = self.sounds.remove(at);
            if let Some(samples) = self.shelf.release(over.samples) {
                outlet.discard(Garbage::Samples(samples));
            }
            if over.own && !self.sounds.iter().any(|sound| sound.own && sound.input == over.input) {
                self.convolver.clear(over.input, |garbage| outlet.discard(garbage));
            }
            outlet.report(Report::Ended { voice: over.whose.voice, sample: end });
        }
    }

    /// Whether anything of what the command of number `id` began still enters.
    pub(crate) fn holds(&self, id: u64) -> bool {
        self.sounds.iter().any(|sound| sound.whose.id == id)
    }

    /// Adds to the drives that sounded before (outputs x samples) what was kept for the waveforms, ahead of
    /// the drives that begin in this block.
    pub(crate) fn fall(&self, out: &mut [f32]) {
        if self.is_idle() {
            return;
        }
        let (level, now) = (&self.level, &self.now);
        self.arch.dispatch(Wide(
            #[inline(always)]
            || level.fall(now, out),
        ));
    }

    /// Adds the rest of the waveforms to the drives of the block (outputs x samples), as loud as leaves all
    /// within limits.
    pub(crate) fn mix(&mut self, clock: u64, ledger: &Ledger, out: &mut [f32], outlet: &mut Outlet) {
        if self.is_idle() {
            return self.level.rest(outlet);
        }
        let (level, now, next) = (&mut self.level, &self.now, &self.next);
        let limited = self.arch.dispatch(Wide(
            #[inline(always)]
            || level.mix([now, next], clock, ledger, out),
        ));
        self.level.tell(clock, limited, outlet);
    }

    /// Sample of the clock from which on nothing of a waveform enters.
    fn end(&self, at: usize) -> u64 {
        let sound = &self.sounds[at];
        let whole = match self.shelf.get(sound.samples) {
            Some(samples) if !sound.looped => sound.start.saturating_add(samples.len() as u64),
            Some(_) => u64::MAX,
            None => 0,
        };
        sound.fade.map_or(whole, |fade| whole.min(fade.end()))
    }

    /// Adds a waveform to what enters its input in the block that begins at `clock`.
    fn enter(&mut self, at: usize, clock: u64) {
        let sound = &self.sounds[at];
        let Some(samples) = self.shelf.get(sound.samples) else { return };
        let (from, to) = (sound.start.max(clock), self.end(at).min(clock + self.block as u64));
        let entering = &mut self.entering[sound.input * self.block..(sound.input + 1) * self.block];
        for sample in from..to {
            let x = samples[((sample - sound.start) % samples.len() as u64) as usize];
            let weight = sound.fade.map_or(1.0, |fade| fade.weight(sample));
            let entering = &mut entering[(sample - clock) as usize];
            *entering = playable(*entering + playable(sound.gain * x) * weight);
        }
    }
}

/// A sample, or silence in the place of one that cannot be played.
fn playable(x: f32) -> f32 {
    if x.abs() <= HUGE { x } else { 0.0 }
}
