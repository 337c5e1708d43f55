//! Waveforms that go on and on: what enters the convolver, and how loud what leaves it may be.

mod level;

use crate::copies::Fade;
use crate::error::HUGE;
use crate::kernels::Wide;
use crate::ledger::Ledger;
use crate::outlet::Outlet;
use crate::shelf::{Garbage, Shelf};
use crate::{Convolver, Options, PlayerError, PreparedFilters, Report, Voice, WaveOptions, Why};
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
    /// What leaves in this block and, known a block ahead, in the next; planar.
    now: Vec<f32>,
    next: Vec<f32>,
    level: Level,
    arch: Arch,
}

/// A prepared waveform that enters an input.
struct Sound {
    voice: Voice,
    input: usize,
    samples: usize,
    start: u64,
    gain: f32,
    looped: bool,
    fade: Option<Fade>,
}

impl Waves {
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
            arch: Arch::new(),
            options: waves,
            block,
        })
    }

    pub(crate) fn convolver(&self) -> &Convolver {
        &self.convolver
    }

    /// Most shared data held at once.
    pub(crate) fn places(&self) -> usize {
        self.convolver.places() + self.options.sounds
    }

    /// Begins a block: keeps in the ledger what the waveforms need of it even if they are to fall as fast as they may.
    pub(crate) fn advance(&mut self, ledger: &mut Ledger) {
        std::mem::swap(&mut self.now, &mut self.next);
        let (level, now) = (&mut self.level, &self.now);
        self.arch.dispatch(Wide(
            #[inline(always)]
            || level.reserve(now, ledger),
        ));
    }

    /// Turns an input to other filters.
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
        if filters.shape != self.convolver.plan().shape() {
            outlet.discard(Garbage::Filters(filters));
            return outlet.refuse(None, Why::Outputs);
        }
        let blocks = fade.div_ceil(self.block as u32);
        if let Some(unused) = self.convolver.turn(input, filters, blocks) {
            outlet.discard(Garbage::Filters(unused));
        }
    }

    /// Starts a waveform.
    pub(crate) fn start(
        &mut self,
        (voice, input): (Voice, usize),
        samples: Arc<[f32]>,
        start: u64,
        (gain, looped): (f32, bool),
        outlet: &mut Outlet,
    ) {
        let refused = match () {
            () if input >= self.options.inputs => Some(Why::Input),
            () if samples.is_empty() => Some(Why::Samples),
            () if !gain.is_finite() => Some(Why::Gain),
            () => None,
        };
        if let Some(why) = refused {
            outlet.discard(Garbage::Samples(samples));
            return outlet.refuse(Some(voice), why);
        }
        match self.shelf.put(samples) {
            Ok(samples) => {
                self.sounds.push(Sound { voice, input, samples, start, gain, looped, fade: None });
                outlet.report(Report::Started { voice, sample: start, gain });
            }
            Err(samples) => {
                outlet.discard(Garbage::Samples(samples));
                outlet.refuse(Some(voice), Why::Copies);
            }
        }
    }

    /// Fades waveforms out.
    pub(crate) fn stop(&mut self, voice: Voice, sample: u64, fade: Option<u32>) {
        let length = fade.unwrap_or(0).max(self.block as u32);
        for sound in self.sounds.iter_mut().filter(|sound| sound.voice == voice) {
            let from = if sound.fade.is_some() { sample - sample % self.block as u64 } else { sample };
            sound.fade = Some(Fade::after(sound.fade, from, length));
        }
    }

    /// Convolves what enters in the block that begins at `clock`.
    pub(crate) fn render(&mut self, clock: u64, outlet: &mut Outlet) {
        for (feed, entering) in self.feeds.iter_mut().zip(self.entering.chunks_exact_mut(self.block)) {
            entering.iter_mut().for_each(|to| *to = feed.pop().map_or(0.0, playable));
        }
        let mut at = 0;
        while at < self.sounds.len() {
            self.enter(at, clock);
            let (voice, end) = (self.sounds[at].voice, self.end(at));
            if end > clock + self.block as u64 {
                at += 1;
                continue;
            }
            let over = self.sounds.remove(at);
            if let Some(samples) = self.shelf.release(over.samples) {
                outlet.discard(Garbage::Samples(samples));
            }
            outlet.report(Report::Ended { voice, sample: end });
        }
        let leave = |garbage| outlet.discard(garbage);
        self.convolver.process_leaving(&self.entering, &mut self.next, leave);
    }

    /// Adds the waveforms to the drives of the block, as loud as leaves all within limits.
    pub(crate) fn mix(&mut self, clock: u64, ledger: &Ledger, out: &mut [f32], outlet: &mut Outlet) {
        let (level, now, next) = (&mut self.level, &self.now, &self.next);
        let limited = self.arch.dispatch(Wide(
            #[inline(always)]
            || level.mix([now, next], clock, ledger, out),
        ));
        self.level.tell(clock, limited, outlet);
    }

    fn end(&self, at: usize) -> u64 {
        let sound = &self.sounds[at];
        let whole = match self.shelf.get(sound.samples) {
            Some(samples) if !sound.looped => sound.start.saturating_add(samples.len() as u64),
            Some(_) => u64::MAX,
            None => 0,
        };
        sound.fade.map_or(whole, |fade| whole.min(fade.end()))
    }

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
