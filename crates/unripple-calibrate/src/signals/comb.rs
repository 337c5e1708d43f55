//! Pruned Fourier transforms: only the lines in the band, by decimation in time.

use super::transform::{Transform, turns};
use std::f64::consts::TAU;
use unripple_dsp::Complex;

/// Fourier transform that yields only a range of spectral lines, by decimation in time: the signal is split into `teeth`
/// interleaved signals, each transformed alone within the processor's caches, and joined in the lines of the range only.
///
/// Source: H. V. Sorensen, C. S. Burrus, "Efficient computation of the DFT with only a subset of input or output points",
/// IEEE Trans. Signal Processing 41 (1993), section III (transform decomposition).
#[derive(Clone, Debug)]
pub(super) struct Comb {
    size: usize,
    teeth: usize,
    part: Transform,
    first: usize,
    /// e^{-2πjk/size} of the lines k of the range.
    turns: Vec<Complex<f64>>,
}

/// Buffers of a [`Comb`]; each thread needs its own.
pub(super) struct CombWork {
    /// The interleaved signals, one after another.
    parts: Vec<f64>,
    lines: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    /// Spectrum at the lines of the range.
    pub band: Vec<Complex<f64>>,
}

impl CombWork {
    /// Number of samples of the signal for which the buffers are made.
    pub fn size(&self) -> usize {
        self.parts.len()
    }
}

/// Largest number of interleaved signals: with more, joining them takes longer than the transforms save.
/// Half as many are somewhat slower.
const MOST: usize = 8;

impl Comb {
    /// A transform of `size` samples that yields only the lines `first..end` of the spectrum.
    pub fn new(size: usize, first: usize, end: usize) -> Self {
        let fits = |teeth: &usize| size.is_multiple_of(*teeth) && end <= size / teeth / 2;
        let teeth = [MOST, MOST / 2, MOST / 4].into_iter().find(fits).unwrap_or(1);
        let part = Transform::exact(size / teeth);
        Self {
            size,
            teeth,
            part,
            first,
            turns: turns(-TAU / size as f64, first).take(end.saturating_sub(first)).collect(),
        }
    }

    /// Number of samples of the signal that is transformed.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Creates a workspace for one thread.
    pub fn work(&self) -> CombWork {
        let one = self.part.work();
        CombWork {
            parts: vec![0.0; self.size],
            lines: one.lines,
            scratch: one.scratch,
            band: vec![Complex::default(); self.turns.len()],
        }
    }

    /// Transforms the samples of a signal, zero beyond its end, and writes the lines of the range to `work.band`.
    pub fn forward(&self, signal: &[f64], work: &mut CombWork) {
        let length = self.size / self.teeth;
        for (tooth, part) in work.parts.chunks_mut(length).enumerate() {
            let given = signal.get(tooth..).unwrap_or(&[]).iter().step_by(self.teeth);
            let filled = given.len().min(length);
            part[..filled].iter_mut().zip(given).for_each(|(to, from)| *to = *from);
            part[filled..].fill(0.0);
        }
        work.band.fill(Complex::default());
        for part in work.parts.chunks_mut(length).rev() {
            self.part.forward_in(part, &mut work.lines, &mut work.scratch);
            let joined = work.band.iter_mut().zip(&work.lines[self.first..]).zip(&self.turns);
            joined.for_each(|((sum, line), turn)| *sum = *sum * turn + line);
        }
    }

    /// The inverse transform of `work.band`, with all other lines 0: fills `signal` with the first samples
    /// of the result. `work.band` is overwritten with products of the phase factors.
    pub fn inverse(&self, work: &mut CombWork, signal: &mut [f64]) {
        let (length, end) = (self.size / self.teeth, self.first + self.turns.len());
        for part in work.parts.chunks_mut(length) {
            work.lines[..self.first].fill(Complex::default());
            work.lines[self.first..end].copy_from_slice(&work.band);
            work.lines[end..].fill(Complex::default());
            self.part.inverse_in(&mut work.lines, part, &mut work.scratch);
            work.band.iter_mut().zip(&self.turns).for_each(|(line, turn)| *line *= turn.conj());
        }
        for (tooth, part) in work.parts.chunks(length).enumerate() {
            let places = signal.iter_mut().skip(tooth).step_by(self.teeth);
            places.zip(part).for_each(|(to, from)| *to = *from);
        }
    }
}
