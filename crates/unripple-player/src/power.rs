//! Running rms of each actuator, kept below its limit: peak, short-term and thermal.

use crate::kernels::{self, Energies};
use crate::{Options, Which};
use std::ops::Range;

/// Share of a limit on the power that waveforms may use, so that some is left for drives. Halved, waveforms alone reach
/// 3 dB less of such a limit; at 1, drives that come beside them would find nothing.
const WAVES_SHARE: f64 = 0.75;

/// Running powers of all actuators that have a limit on them, and the largest power allowed at the start of each future
/// block, so that what has been started stays within the limit.
pub(crate) struct Powers {
    blocks: usize,
    tracks: Vec<Track>,
    /// First limit of each output, and how many there are in all.
    whose: Vec<usize>,
    /// Energy of max(P, N), output x block of the ring.
    energies: Vec<f64>,
}

struct Track {
    output: usize,
    kind: Which,
    /// Limit on the power, with a guard for rounding.
    most: f64,
    /// Factor on the power over one block, its inverse, and the factor on a sample's square as it enters.
    decay: f64,
    growth: f64,
    share: f64,
    /// Weight of each sample's square of a block in the power at the block's end.
    weights: Vec<f32>,
    power: f64,
    /// Largest power that may be at the start of each block of the ring.
    ceilings: Vec<f64>,
}

impl Powers {
    /// Powers of nothing emitted yet, over a ring of a number of blocks.
    pub(crate) fn new(options: &Options, blocks: usize) -> Self {
        let (mut tracks, mut whose) = (Vec::new(), vec![0]);
        for output in 0..options.outputs {
            let limit = options.limit(output);
            for (kind, running) in [(Which::Rms, limit.rms), (Which::Thermal, limit.thermal)] {
                let Some(running) = running else { continue };
                let step = (-1.0 / (running.seconds * options.rate)).exp();
                let share = -(-1.0 / (running.seconds * options.rate)).exp_m1();
                let weight = |i: usize| (share * step.powi((options.block - 1 - i) as i32)) as f32;
                let most = running.level * running.level * (1.0 - 1e-5);
                tracks.push(Track {
                    output,
                    kind,
                    most,
                    decay: step.powi(options.block as i32),
                    growth: step.powi(-(options.block as i32)),
                    share,
                    weights: (0..options.block).map(weight).collect(),
                    power: 0.0,
                    ceilings: vec![most; blocks],
                });
            }
            whose.push(tracks.len());
        }
        let energies = if tracks.is_empty() { Vec::new() } else { vec![0.0; options.outputs * blocks] };
        Self { blocks, tracks, whose, energies }
    }

    /// Number of limits on the power, over all outputs.
    pub(crate) fn count(&self) -> usize {
        self.tracks.len()
    }

    /// Kind and output of a limit, by its index.
    pub(crate) fn whose(&self, which: usize) -> (Which, usize) {
        (self.tracks[which].kind, self.tracks[which].output)
    }

    /// Sets the energy of max(P, N) of an output over a block of the ring: a sum of squares.
    pub(crate) fn set_energy(&mut self, output: usize, slot: usize, energy: f64) {
        self.energies[output * self.blocks + slot] = energy;
    }

    /// Brings the ceilings up to date from the changed block of number `last` back to the present one.
    #[inline(always)]
    pub(crate) fn look_back(&mut self, now: u64, last: u64) {
        let blocks = self.blocks as u64;
        for track in &mut self.tracks {
            let energies = &self.energies[track.output * self.blocks..(track.output + 1) * self.blocks];
            for block in (now..=last).rev() {
                let slot = (block % blocks) as usize;
                let next = track.ceilings[((block + 1) % blocks) as usize];
                let enters = track.share * energies[slot];
                track.ceilings[slot] = f64::min(track.most - enters, (next - enters) * track.growth);
            }
        }
    }

    /// Indices of the limits that an output has.
    pub(crate) fn of(&self, output: usize) -> Range<usize> {
        self.whose[output]..self.whose[output + 1]
    }

    /// Share of its limits that an output, by its index, has used up, as rms: 0 to 1.
    pub(crate) fn used(&self, output: usize) -> f32 {
        let share = |track: &Track| (track.power / track.most).sqrt() as f32;
        self.tracks[self.of(output)].iter().map(share).fold(0.0, f32::max)
    }

    /// Goes through future blocks from the present power, for the limit of an index, with something new of
    /// this gain (a factor).
    pub(crate) fn walk(&self, which: usize, gain: f64) -> Walk<'_> {
        let track = &self.tracks[which];
        let energies = &self.energies[track.output * self.blocks..(track.output + 1) * self.blocks];
        Walk::new(track, energies, gain)
    }

    /// Ends a block: powers of what was emitted (outputs x samples).
    #[inline(always)]
    pub(crate) fn settle(&mut self, emitted: &[f32], block: usize, index: u64) {
        let slot = (index % self.blocks as u64) as usize;
        for track in &mut self.tracks {
            let samples = &emitted[track.output * block..(track.output + 1) * block];
            track.power = track.decay * track.power + kernels::weighted_energy(samples, &track.weights);
            track.ceilings[slot] = track.most;
        }
        for output in 0..self.energies.len() / self.blocks.max(1) {
            self.energies[output * self.blocks + slot] = 0.0;
        }
    }

    /// Largest factor for which the power stays within a limit, and within the waveforms' share of it, where this block emits
    /// what is held plus the factor times what rises, and the next block the factor times what falls on top of what is
    /// committed.
    pub(crate) fn wave_room(&self, which: usize, now: u64, wave: &WaveEnergies) -> f64 {
        let track = &self.tracks[which];
        let blocks = self.blocks as u64;
        let next = self.energies[track.output * self.blocks + ((now + 1) % blocks) as usize];
        let (energies, most) = ([wave.held, next], track.most * WAVES_SHARE);
        let mut walk = Walk::new(track, &energies, 1.0);
        for (slot, part) in [wave.rising, wave.falling].into_iter().enumerate() {
            walk.pass(slot, part);
            walk.limit(most, walk.power);
        }
        walk.room(now + 2)
    }
}

/// Energies of waveforms over the block at hand and the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WaveEnergies {
    /// Energy of what this block emits whatever the gain will be.
    pub(crate) held: f64,
    /// Energies of what rises with the gain, beside that.
    pub(crate) rising: Energies,
    /// Energies of what the next block may emit, beside what is committed.
    pub(crate) falling: Energies,
}

/// Running power of what has been started plus g times a new signal, from block to block: held + 2 g cross + g² own.
pub(crate) struct Walk<'a> {
    track: &'a Track,
    energies: &'a [f64],
    power: [f64; 3],
    gain: f64,
}

impl<'a> Walk<'a> {
    fn new(track: &'a Track, energies: &'a [f64], gain: f64) -> Self {
        Self { track, energies, power: [track.power, 0.0, 0.0], gain }
    }

    /// Passes a block of the ring, by its index, to which something new brings so much energy.
    #[inline(always)]
    pub(crate) fn pass(&mut self, slot: usize, new: Energies) {
        let Track { share, decay, most, .. } = *self.track;
        let enters = [self.energies[slot], new.cross, new.own].map(|energy| share * energy);
        let sum = |scale: f64| [0, 1, 2].map(|i| scale * self.power[i] + enters[i]);
        let (highest, end) = (sum(1.0), sum(decay));
        self.limit(most, highest);
        self.power = end;
    }

    /// The largest gain (a factor) up to that asked for, given that the block of number `next` follows.
    pub(crate) fn room(mut self, next: u64) -> f64 {
        let ceilings = &self.track.ceilings;
        let most = ceilings[(next % ceilings.len() as u64) as usize];
        self.limit(most, self.power);
        self.gain
    }

    /// Lowers the gain, if need be, to the positive root of held + 2 g cross + g² own = most, written without a difference.
    #[inline(always)]
    fn limit(&mut self, most: f64, [held, cross, own]: [f64; 3]) {
        let g = self.gain;
        if own > 0.0 && held + g * (2.0 * cross + g * own) > most {
            let free = most - held;
            let root = free / (cross + (cross * cross + own * free).sqrt());
            self.gain = if free > 0.0 { g.min(root) } else { 0.0 };
        }
    }
}
