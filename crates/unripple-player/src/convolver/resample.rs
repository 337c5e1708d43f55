//! Low-pass filters for convolution at a lower rate.

use std::f64::consts::PI;
use unripple_dsp::{bessel_i0, sinc};

/// Attenuation that the low-pass filters are made for, in dB; their ripple is as small. With twice this value, filters are
/// twice as long for what float32 cannot hold.
const ATTENUATION: f64 = 100.0;

/// The low-pass filter of a change of rate by `factor`, of 2 · `half` + 1 taps about its middle, with a sum of 1: a sinc under a
/// Kaiser window (Kaiser, in *System Analysis by Digital Computer*, 1966, chapter 7).
///
/// The filter passes frequencies up to the top of the band, and stops those that would be aliased onto them.
#[derive(Clone, Debug)]
pub(crate) struct LowPass {
    /// Samples of the full rate for each of the lower.
    pub(crate) factor: usize,
    /// Taps to each side of the middle: a multiple of the factor.
    pub(crate) half: usize,
    /// The taps, in order, 2 · `half` + 1 of them.
    pub(crate) taps: Vec<f64>,
}

impl LowPass {
    /// For a change by `factor` and a band up to `top` times the full rate (a ratio), of at most a third of
    /// the lower rate.
    pub(crate) fn new(factor: usize, top: f64) -> Self {
        if factor == 1 {
            return Self { factor, half: 0, taps: vec![1.0] };
        }
        let (middle, width) = (0.5 / factor as f64, 1.0 / factor as f64 - 2.0 * top);
        let half = (ATTENUATION - 8.0) / (2.285 * 2.0 * PI * width) / 2.0;
        let half = (half.ceil() as usize).next_multiple_of(factor);
        let beta = 0.1102 * (ATTENUATION - 8.7);
        let tap = |i: usize| {
            let t = i as f64 - half as f64;
            let u = t / (half as f64 + 1.0);
            sinc(2.0 * middle * t) * bessel_i0(beta * (1.0 - u * u).sqrt())
        };
        let mut taps: Vec<f64> = (0..=2 * half).map(tap).collect();
        let sum: f64 = taps.iter().sum();
        taps.iter_mut().for_each(|tap| *tap /= sum);
        Self { factor, half, taps }
    }

    /// The tap `from` samples after the middle.
    pub(crate) fn about(&self, from: i64) -> f64 {
        usize::try_from(from + self.half as i64).ok().and_then(|at| self.taps.get(at)).copied().unwrap_or(0.0)
    }
}

/// The largest factor that divides the block and leaves room for a transition as wide as the band: a third of the lower
/// rate is the band.
pub(crate) fn factor(block: usize, rate: f64, top: f64) -> usize {
    (1..=block / 4).rev().find(|f| block.is_multiple_of(*f) && rate / *f as f64 >= 3.0 * top).unwrap_or(1)
}

/// Decimator of one input, to the lower rate.
pub(crate) struct Decimator {
    taps: Vec<f32>,
    factor: usize,
    history: Vec<f32>,
}

impl Decimator {
    /// A decimator for blocks of `block` samples at the full rate, with silence before the first block.
    pub(crate) fn new(filter: &LowPass, block: usize) -> Self {
        let taps: Vec<f32> = filter.taps.iter().rev().map(|&tap| tap as f32).collect();
        Self { history: vec![0.0; taps.len() - 1 + block], factor: filter.factor, taps }
    }

    /// Takes a block at the full rate, and gives its samples at the lower rate.
    #[inline(always)]
    pub(crate) fn process(&mut self, input: &[f32], output: &mut [f32]) {
        let kept = self.taps.len() - 1;
        let end = self.history.len();
        self.history.copy_within(end - kept.., 0);
        self.history[kept..].copy_from_slice(input);
        for (output, window) in
            output.iter_mut().zip(self.history.windows(self.taps.len()).step_by(self.factor))
        {
            *output = dot(&self.taps, window);
        }
    }
}

/// Interpolator of one output, to the full rate.
pub(crate) struct Interpolator {
    /// Taps of each phase, the last sample's first.
    phases: Vec<Vec<f32>>,
    history: Vec<f32>,
    wide: Vec<f32>,
}

impl Interpolator {
    /// An interpolator for blocks of `low_block` samples at the lower rate, with silence before the first
    /// block.
    pub(crate) fn new(filter: &LowPass, low_block: usize) -> Self {
        let factor = filter.factor;
        let length = 2 * filter.half / factor + 1;
        let tap = |phase: usize, j: usize| {
            filter.taps.get(phase + j * factor).map_or(0.0, |&tap| tap * factor as f64)
        };
        let phase = |phase: usize| (0..length).map(|j| tap(phase, j) as f32).collect();
        Self {
            phases: (0..factor).map(phase).collect(),
            history: vec![0.0; length - 1 + low_block],
            wide: vec![0.0; low_block],
        }
    }

    /// Takes a block at the lower rate, and gives its samples at the full rate.
    #[inline(always)]
    pub(crate) fn process(&mut self, input: &[f32], output: &mut [f32]) {
        let (low, factor) = (self.wide.len(), self.phases.len());
        let kept = self.history.len() - low;
        self.history.copy_within(low.., 0);
        self.history[kept..].copy_from_slice(input);
        for (phase, taps) in self.phases.iter().enumerate() {
            self.wide.fill(0.0);
            for (j, &tap) in taps.iter().enumerate() {
                let from = &self.history[kept - j..kept - j + low];
                self.wide.iter_mut().zip(from).for_each(|(to, &from)| *to += tap * from);
            }
            output.iter_mut().skip(phase).step_by(factor).zip(&self.wide).for_each(|(to, &from)| *to = from);
        }
    }
}

#[inline(always)]
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<16>(), b.as_chunks::<16>());
    let mut lanes = [0f32; 16];
    for (a, b) in a.iter().zip(b) {
        for l in 0..16 {
            lanes[l] += a[l] * b[l];
        }
    }
    lanes.iter().sum::<f32>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f32>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_the_band_and_stops_what_folds_onto_it() {
        for (factor, top) in [(4, 1.0 / 16.0), (2, 1.0 / 6.0), (8, 1.0 / 24.0), (3, 0.05)] {
            let filter = LowPass::new(factor, top);
            let at = |f: f64| -> f64 {
                let angle = |i: i64| (2.0 * PI * f * i as f64).cos();
                (-(filter.half as i64)..=filter.half as i64).map(|i| filter.about(i) * angle(i)).sum()
            };
            for part in 0..=50 {
                let share = f64::from(part) / 50.0;
                let (low, high) = (at(share * top), at(1.0 / factor as f64 - top + share * top));
                assert!((low - 1.0).abs() < 3e-5 && high.abs() < 3e-5, "{factor}: {low} {high}");
            }
        }
    }

    #[test]
    fn the_factor_divides_the_block() {
        assert_eq!(factor(64, 48e3, 3e3), 4);
        assert_eq!(factor(64, 48e3, 2e3), 8);
        assert_eq!(factor(60, 48e3, 3e3), 5);
        assert_eq!(factor(67, 48e3, 3e3), 1);
        assert_eq!(factor(64, 48e3, 24e3), 1);
    }
}
