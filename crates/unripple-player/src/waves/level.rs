//! One gain for all waveforms. Drives come first: the waveforms get what is left, of the peak and of a share of the power.
//!
//! The gain runs along a straight line over each block. It is chosen so that this block stays within limits and that, should
//! drives take all that is left from then on, the gain could fall to nothing over the next block, whose samples are
//! known, and stay within: so drives need to leave no more than that fall. It rises again slowly.
//!
//! The fall is put into the ledger before the drives that begin in a block, and is mixed in just there: sums are then taken in the
//! order in which the ledger took them, and what it allows is kept to the last bit, however many drives there are. What rises beside
//! the fall comes last, with a guard for the rounding of one sum.

use crate::ledger::Ledger;
use crate::outlet::Outlet;
use crate::power::WaveEnergies;
use crate::{Count, Options, Report, Which, kernels};

/// Seconds that the gain takes to rise from nothing to 1. With twice this value, waveforms come back half as fast after
/// drives took their room; shorter, their level follows each drive more noticeably.
const RISE: f64 = 0.1;

/// Shares of the peak that are kept off the waveforms, so that the rounding of a sum cannot pass the limit: in the block at hand and,
/// where a gain is rounded besides, in the next.
const GUARDS: [f32; 2] = [1e-6, 1e-5];

/// The gain of all waveforms, and what it needs from block to block.
pub(crate) struct Level {
    block: usize,
    gain: f32,
    rise: f32,
    was_limited: bool,
    /// Share of a block gone by at each of its samples.
    along: Vec<f32>,
    reserved: Vec<f32>,
    held: Vec<f32>,
    rising: Vec<f32>,
    falling: Vec<f32>,
}

type Limited = Option<(Which, usize)>;

impl Level {
    /// A gain of 1, nothing reserved.
    pub(crate) fn new(options: &Options) -> Self {
        let block = options.block;
        Self {
            block,
            gain: 1.0,
            rise: (block as f64 / (RISE * options.rate)) as f32,
            was_limited: false,
            along: (0..block).map(|i| (i + 1) as f32 / block as f32).collect(),
            reserved: vec![0.0; options.outputs * block],
            held: vec![0.0; block],
            rising: vec![0.0; block],
            falling: vec![0.0; block],
        }
    }

    /// Tells the ledger what waveforms (outputs x samples) take of this block if they fall as fast as they
    /// may.
    #[inline(always)]
    pub(crate) fn reserve(&mut self, now: &[f32], ledger: &mut Ledger) {
        let (block, gain) = (self.block, self.gain);
        let channels = self.reserved.chunks_exact_mut(block).zip(now.chunks_exact(block));
        for (reserved, now) in channels {
            for ((to, x), along) in reserved.iter_mut().zip(now).zip(&self.along) {
                *to = gain * (1.0 - along) * x.abs();
            }
        }
        ledger.reserve(&self.reserved);
    }

    /// Adds what was reserved, to the last bit.
    #[inline(always)]
    pub(crate) fn fall(&self, now: &[f32], out: &mut [f32]) {
        for (out, now) in out.chunks_exact_mut(self.block).zip(now.chunks_exact(self.block)) {
            for ((out, x), along) in out.iter_mut().zip(now).zip(&self.along) {
                *out += self.gain * (1.0 - along) * x;
            }
        }
    }

    /// Chooses the gain (a factor) at the end of this block, and adds what rises with it. Says what kept the
    /// gain below 1 and from rising.
    #[inline(always)]
    pub(crate) fn mix(
        &mut self,
        [now, next]: [&[f32]; 2],
        clock: u64,
        ledger: &Ledger,
        out: &mut [f32],
    ) -> Limited {
        let block = self.block;
        let mut most = kernels::smaller(self.gain + self.rise, 1.0);
        let mut by = None;
        for output in 0..out.len() / block {
            let channel = output * block..(output + 1) * block;
            let room =
                self.room([&now[channel.clone()], &next[channel.clone()], &out[channel]], ledger, output);
            if room < most {
                (most, by) = (room, Some((Which::Peak, output)));
            }
        }
        let index = clock / block as u64;
        for which in 0..ledger.powers().count() {
            let (kind, output) = ledger.powers().whose(which);
            let channel = output * block..(output + 1) * block;
            let wave = [&now[channel.clone()], &next[channel.clone()], &out[channel]];
            let energies = self.energies(wave, ledger, output);
            let room = ledger.powers().wave_room(which, index, &energies) as f32;
            if room < most {
                (most, by) = (room, Some((kind, output)));
            }
        }
        let gain = kernels::above(most);
        for (out, now) in out.chunks_exact_mut(block).zip(now.chunks_exact(block)) {
            for ((out, x), along) in out.iter_mut().zip(now).zip(&self.along) {
                *out += gain * along * x;
            }
        }
        self.gain = gain;
        by
    }

    /// Raises the gain for a block without waveforms, as mixing silence would.
    pub(crate) fn rest(&mut self, outlet: &mut Outlet) {
        self.gain = kernels::smaller(self.gain + self.rise, 1.0);
        self.was_limited = self.gain < 1.0;
        outlet.meters.set_wave_gain(self.gain);
    }

    /// Reports that waveforms begin to be limited, in the block that begins at sample `clock`.
    pub(crate) fn tell(&mut self, clock: u64, by: Limited, outlet: &mut Outlet) {
        outlet.meters.set_wave_gain(self.gain);
        if let Some((which, output)) = by {
            outlet.meters.add(Count::WavesLimited);
            if !self.was_limited {
                outlet.report(Report::WavesLimited { sample: clock, gain: self.gain, which, output });
            }
        }
        self.was_limited = self.gain < 1.0;
    }

    /// Largest gain at the end of this block that the peak leaves an output.
    #[inline(always)]
    fn room(&self, [now, next, out]: [&[f32]; 3], ledger: &Ledger, output: usize) -> f32 {
        let limit = ledger.peak(output);
        let (positive, negative) = ledger.bounds(output, 1);
        let (free, later) = (limit * (1.0 - GUARDS[0]), limit * (1.0 - GUARDS[1]));
        let mut least = f32::INFINITY;
        for i in 0..self.block {
            let (along, back) = (self.along[i], 1.0 - self.along[i]);
            let here = (free - out[i].abs()) / (along * now[i].abs());
            let held = later - kernels::larger(positive[i], negative[i]);
            // A guard for the rounding of the quotient and of the two sums.
            let there = held / (back * next[i].abs() * (1.0 + 3e-5));
            // Nothing to play leaves room for anything; the quotient may be 0 / 0.
            let here = if now[i] == 0.0 { f32::INFINITY } else { here };
            let there = if back * next[i] == 0.0 { f32::INFINITY } else { there };
            least = kernels::smaller(least, kernels::smaller(here, there));
        }
        least
    }

    /// Energies of an output over this block and the next, for the limits on its power.
    #[inline(always)]
    fn energies(&mut self, [now, next, out]: [&[f32]; 3], ledger: &Ledger, output: usize) -> WaveEnergies {
        for i in 0..self.block {
            let (along, back) = (self.along[i], 1.0 - self.along[i]);
            self.held[i] = out[i].abs();
            self.rising[i] = along * now[i];
            self.falling[i] = back * next[i];
        }
        let (positive, negative) = ledger.bounds(output, 1);
        WaveEnergies {
            held: kernels::energy(&self.held),
            rising: kernels::energies(&self.held, &self.held, &self.rising),
            falling: kernels::energies(positive, negative, &self.falling),
        }
    }
}
