//! Drives that are being played, and their fades.

use crate::origin::Whose;
use crate::shelf::Shelf;
use crate::{PreparedDrive, kernels};

/// A copy of a drive that is being played.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sounding {
    /// The voice, and the command that started it.
    pub(crate) whose: Whose,
    /// Index of its drive on the shelf.
    pub(crate) drive: usize,
    /// Sample of the clock at which it starts.
    pub(crate) start: u64,
    /// Number of samples that it lasts.
    pub(crate) samples: u64,
    /// Factor on its samples, after limiting.
    pub(crate) gain: f32,
    /// Fade-out that ends the copy before its last sample, if there is one.
    pub(crate) fade: Option<Fade>,
}

/// A straight line from `level` just before sample `from` to nothing at sample `from + length`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fade {
    /// Sample of the clock at which it begins to fall.
    pub(crate) from: u64,
    /// Number of samples until it is silent.
    pub(crate) length: u32,
    /// Weight just before it falls, from 0 to 1.
    pub(crate) level: f32,
}

impl Fade {
    /// The weight of a sample, from 0 to 1.
    #[inline(always)]
    pub(crate) fn weight(&self, sample: u64) -> f32 {
        if sample < self.from {
            return self.level;
        }
        let left = self.end().saturating_sub(sample) as f32;
        self.level * (left / (self.length as f32 + 1.0))
    }

    /// First sample of silence.
    pub(crate) fn end(&self) -> u64 {
        self.from + u64::from(self.length)
    }

    /// A fade over `length` samples that begins at sample `from`, or the fade `held` that is already under
    /// way, whichever ends first.
    pub(crate) fn after(held: Option<Self>, from: u64, length: u32) -> Self {
        let level = held.map_or(1.0, |held| held.weight(from.saturating_sub(1)));
        let fade = Self { from, length, level };
        match held {
            Some(held) if held.end() <= fade.end() => held,
            _ => fade,
        }
    }
}

impl Sounding {
    /// First sample of silence.
    pub(crate) fn end(&self) -> u64 {
        let whole = self.start + self.samples;
        self.fade.map_or(whole, |fade| whole.min(fade.end()))
    }

    /// Adds the block that begins at sample `clock` to planar `out` (outputs x samples).
    #[inline(always)]
    pub(crate) fn mix(&self, shelf: &Shelf<PreparedDrive>, clock: u64, block: usize, out: &mut [f32]) {
        let (from, to) = (self.start.max(clock), self.end().min(clock + block as u64));
        let Some(drive) = shelf.get(self.drive) else { return };
        if from >= to {
            return;
        }
        let (into, at) = ((from - clock) as usize, (from - self.start) as usize);
        let length = (to - from) as usize;
        for (output, out) in out.chunks_exact_mut(block).enumerate() {
            let Some(samples) = drive.channel(output).get(at..at + length) else { continue };
            let out = &mut out[into..into + length];
            match self.fade {
                None => kernels::add(out, samples, self.gain),
                Some(fade) => {
                    for (i, (out, x)) in out.iter_mut().zip(samples).enumerate() {
                        *out += self.gain * x * fade.weight(from + i as u64);
                    }
                }
            }
        }
    }
}
