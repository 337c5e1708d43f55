//! Sums of what has been started, for each actuator and future sample, and the share of the actuators'
//! limits that these sums use.
//!
//! Voices add. For each actuator and future sample the ledger holds the sum of all positive parts, P, and of all negative
//! parts, N, of what has been started (gains included). Whatever weights from 0 to 1 fading gives the parts from then on, their sum
//! stays between −N and P: so stopping or fading any voice, in any order, can never pass a limit, not even where parts cancelled
//! each other. max(P, N) is the least bound of which that is true; of parts of random signs it lies hardly above their sum.
//!
//! A drive is wholly known when it starts. It is scaled, as a whole, by the largest g ≤ 1 for which
//!
//! - P and N stay within the peak at every sample. Sums are taken in float32 in the order in which drives are mixed, and rounding
//!   is monotonic, so that this holds for the emitted samples to the last bit, and a drive of just the limit keeps its bits;
//! - the running power of max(P, N) + g|drive| stays within each rms limit at every sample: a quadratic in g, followed block by
//!   block from the power that was in fact emitted so far, each block's energy counted as if it came at its worst sample.
//!
//! Nothing is ever clipped. What stops early is taken out of the ledger again, some blocks of it at a time.

use crate::kernels;
use crate::power::Powers;
use crate::{Options, PreparedDrive, Which};

/// P and N as rings of whole blocks, and the running powers that follow from them.
pub(crate) struct Ledger {
    block: usize,
    outputs: usize,
    /// Samples of the ring, per output.
    span: usize,
    /// First sample of the present block.
    clock: u64,
    peaks: Vec<f32>,
    positive: Vec<f32>,
    negative: Vec<f32>,
    powers: Powers,
}

/// The gain that a drive is given, and the limit that kept it from a higher one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Verdict {
    /// The gain that the drive is given.
    pub(crate) gain: f32,
    /// The limit and the output that kept the gain from being higher; `None` if none did.
    pub(crate) by: Option<(Which, usize)>,
}

/// Factor on a limited gain, so that rounding cannot pass the limit: four last places below 1. With twice as
/// many, gains would be lower by as much more.
const GUARD: f32 = 1.0 - 4.0 * f32::EPSILON;

/// The part of an event within one block: where in the ring, where in the drive, and which block of the ring.
struct Piece {
    ring: std::ops::Range<usize>,
    drive: std::ops::Range<usize>,
    slot: usize,
}

impl Ledger {
    /// A ledger in which nothing has been started.
    pub(crate) fn new(options: &Options) -> Self {
        let blocks = options.longest.div_ceil(options.block) + 2;
        let span = blocks * options.block;
        let peaks = (0..options.outputs).map(|output| rounded_down(options.limit(output).peak)).collect();
        Self {
            block: options.block,
            outputs: options.outputs,
            span,
            clock: 0,
            peaks,
            positive: vec![0.0; options.outputs * span],
            negative: vec![0.0; options.outputs * span],
            powers: Powers::new(options, blocks),
        }
    }

    /// The largest share of `gain` with which a drive that starts at `start`, within this block, passes no limit.
    #[inline(always)]
    pub(crate) fn judge(&self, drive: &PreparedDrive, start: u64, gain: f32) -> Verdict {
        let mut verdict = Verdict { gain, by: None };
        for output in 0..self.outputs {
            self.judge_peak(drive.channel(output), output, start, &mut verdict);
        }
        for output in (0..self.outputs).filter(|&output| !self.powers.of(output).is_empty()) {
            self.judge_power(drive, output, start, &mut verdict);
        }
        verdict
    }

    /// Adds a judged drive to the sums, from sample `start` of the clock on, times `gain`.
    #[inline(always)]
    pub(crate) fn enter(&mut self, drive: &PreparedDrive, start: u64, gain: f32) {
        for output in 0..self.outputs {
            self.enter_channel(drive.channel(output), output, start, gain);
        }
        let last = start + (drive.samples() as u64).saturating_sub(1);
        self.powers.look_back(self.clock / self.block as u64, last / self.block as u64);
    }

    /// Adds one channel of a drive to the sums.
    #[inline(always)]
    fn enter_channel(&mut self, channel: &[f32], output: usize, start: u64, gain: f32) {
        for piece in self.pieces(channel.len(), start) {
            let base = output * self.span;
            let ring = base + piece.ring.start..base + piece.ring.end;
            let (Some(p), Some(n)) = (self.positive.get_mut(ring.clone()), self.negative.get_mut(ring))
            else {
                continue;
            };
            kernels::enter(p, n, &channel[piece.drive], gain);
            if self.powers.count() > 0 {
                self.weigh(output, piece.slot);
            }
        }
    }

    /// Empties the future block of number `block`, to be filled again by [`Ledger::refill`] with every copy in the
    /// order of mixing.
    pub(crate) fn clear(&mut self, block: u64) {
        let at = (block * self.block as u64 % self.span as u64) as usize;
        for output in 0..self.outputs {
            let ring = output * self.span + at..output * self.span + at + self.block;
            self.positive[ring.clone()].fill(0.0);
            self.negative[ring].fill(0.0);
        }
    }

    /// Adds the part of a copy that lies within one block, and before sample `end`, to an emptied block.
    #[inline(always)]
    pub(crate) fn refill(&mut self, block: u64, drive: &PreparedDrive, start: u64, end: u64, gain: f32) {
        let first = block * self.block as u64;
        let (from, to) = (start.max(first), end.min(first + self.block as u64));
        if from >= to {
            return;
        }
        let ring = (from % self.span as u64) as usize;
        let length = (to - from) as usize;
        let at = (from - start) as usize;
        for output in 0..self.outputs {
            let ring = output * self.span + ring..output * self.span + ring + length;
            let Some(channel) = drive.channel(output).get(at..at + length) else { continue };
            kernels::enter(&mut self.positive[ring.clone()], &mut self.negative[ring], channel, gain);
        }
    }

    /// Brings the running powers of a block up to date after [`Ledger::refill`]; blocks are counted from the
    /// clock's start.
    #[inline(always)]
    pub(crate) fn weigh_block(&mut self, block: u64) {
        if self.powers.count() == 0 {
            return;
        }
        let slot = (block * self.block as u64 % self.span as u64) as usize / self.block;
        for output in 0..self.outputs {
            self.weigh(output, slot);
        }
        self.powers.look_back(self.clock / self.block as u64, block);
    }

    /// Adds magnitudes of one sign or the other (outputs x samples) to the present block: what waveforms may
    /// take of it.
    #[inline(always)]
    pub(crate) fn reserve(&mut self, magnitudes: &[f32]) {
        let at = (self.clock % self.span as u64) as usize;
        for (output, channel) in magnitudes.chunks_exact(self.block).enumerate().take(self.outputs) {
            let ring = output * self.span + at..output * self.span + at + self.block;
            kernels::add(&mut self.positive[ring.clone()], channel, 1.0);
            kernels::add(&mut self.negative[ring], channel, 1.0);
            if self.powers.count() > 0 {
                self.weigh(output, at / self.block);
            }
        }
    }

    /// P and N of an output over the block `ahead` blocks from now.
    pub(crate) fn bounds(&self, output: usize, ahead: usize) -> (&[f32], &[f32]) {
        let at =
            output * self.span + ((self.clock % self.span as u64) as usize + ahead * self.block) % self.span;
        (&self.positive[at..at + self.block], &self.negative[at..at + self.block])
    }

    /// Largest magnitude of a sample that an output may emit, in its unit.
    pub(crate) fn peak(&self, output: usize) -> f32 {
        self.peaks[output]
    }

    /// The running powers, and what limits leave of them.
    pub(crate) fn powers(&self) -> &Powers {
        &self.powers
    }

    /// Ends the block that was emitted (outputs x samples).
    #[inline(always)]
    pub(crate) fn settle(&mut self, emitted: &[f32]) {
        let block = self.clock / self.block as u64;
        self.powers.settle(emitted, self.block, block);
        self.clear(block);
        self.clock += self.block as u64;
    }

    #[inline(always)]
    fn weigh(&mut self, output: usize, slot: usize) {
        let at = output * self.span + slot * self.block;
        let (p, n) = (&self.positive[at..at + self.block], &self.negative[at..at + self.block]);
        self.powers.set_energy(output, slot, kernels::bound_energy(p, n));
    }

    /// Lowers the gain to what the peak leaves a channel.
    #[inline(always)]
    fn judge_peak(&self, channel: &[f32], output: usize, start: u64, verdict: &mut Verdict) {
        let limit = self.peaks[output];
        // Loops rather than closures: they are widened together with what calls them.
        let mut highest = 0.0;
        for piece in self.pieces(channel.len(), start) {
            let ring = output * self.span + piece.ring.start..output * self.span + piece.ring.end;
            let (p, n) = (&self.positive[ring.clone()], &self.negative[ring]);
            let here = kernels::highest(p, n, &channel[piece.drive], verdict.gain);
            highest = kernels::larger(highest, here);
        }
        if highest <= limit {
            return;
        }
        let sign = if verdict.gain < 0.0 { -1.0 } else { 1.0 };
        let mut room = f32::INFINITY;
        for piece in self.pieces(channel.len(), start) {
            let ring = output * self.span + piece.ring.start..output * self.span + piece.ring.end;
            let (p, n) = (&self.positive[ring.clone()], &self.negative[ring]);
            room = kernels::smaller(room, kernels::room(p, n, &channel[piece.drive], sign, limit));
        }
        let gain = sign * kernels::smaller(room, verdict.gain.abs()) * GUARD;
        *verdict = Verdict { gain, by: Some((Which::Peak, output)) };
    }

    /// Lowers the gain to what the limits on the power leave a channel.
    #[inline(always)]
    fn judge_power(&self, drive: &PreparedDrive, output: usize, start: u64, verdict: &mut Verdict) {
        let channel = drive.channel(output);
        let limits = self.powers.of(output);
        let asked = f64::from(verdict.gain.abs());
        let mut walks = [limits.start, limits.end - 1].map(|which| self.powers.walk(which, asked));
        for piece in self.pieces(channel.len(), start) {
            let ring = output * self.span + piece.ring.start..output * self.span + piece.ring.end;
            let (p, n) = (&self.positive[ring.clone()], &self.negative[ring]);
            let energies = kernels::energies(p, n, &channel[piece.drive]);
            for walk in &mut walks {
                walk.pass(piece.slot, energies);
            }
        }
        let next = (start + channel.len() as u64).div_ceil(self.block as u64);
        for (walk, which) in walks.into_iter().zip([limits.start, limits.end - 1]) {
            let room = walk.room(next);
            if room < asked && room < f64::from(verdict.gain.abs()) {
                let gain = verdict.gain.signum() * (room as f32) * GUARD;
                *verdict = Verdict { gain, by: Some(self.powers.whose(which)) };
            }
        }
    }

    /// The parts of an event of `samples` samples, block by block.
    #[inline(always)]
    fn pieces(&self, samples: usize, start: u64) -> impl Iterator<Item = Piece> + use<> {
        let (block, span) = (self.block, self.span);
        let mut done = 0;
        std::iter::from_fn(move || {
            if done >= samples {
                return None;
            }
            let at = ((start + done as u64) % span as u64) as usize;
            let length = (block - at % block).min(samples - done);
            let drive = done..done + length;
            done += length;
            Some(Piece { ring: at..at + length, drive, slot: at / block })
        })
    }
}

/// The largest float32 that is not above a positive number.
fn rounded_down(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}
