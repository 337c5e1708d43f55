//! Real fast Fourier transforms of one size, with their scratch buffers.

use std::cell::RefCell;
use std::sync::Arc;
use unripple_dsp::{Complex, ComplexToReal, FourierPlanner, RealToComplex, smooth_size};

/// Number of plans that a thread caches: a measurement uses the same few sizes again and again, and planning
/// one takes as long as three transforms of it. Each plan holds as much memory as a signal.
const KEPT: usize = 8;

thread_local! {
    /// The plans used last, the latest at the end.
    static PLANS: RefCell<Vec<Transform>> = const { RefCell::new(Vec::new()) };
}

/// Fourier transforms of real signals of one size, without scaling either way.
#[derive(Clone)]
pub(super) struct Transform {
    size: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

/// Buffers of one transform: signal, spectrum, scratch.
pub(super) struct Work {
    /// Samples of the signal.
    pub signal: Vec<f64>,
    /// Spectrum of the signal, from 0 to half the rate.
    pub lines: Vec<Complex<f64>>,
    /// Scratch memory of the transform itself.
    pub scratch: Vec<Complex<f64>>,
}

impl std::fmt::Debug for Transform {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transform").field("size", &self.size).finish()
    }
}

impl Transform {
    /// A transform of exactly `size` samples, or of one sample if `size` is 0.
    pub fn exact(size: usize) -> Self {
        let size = size.max(1);
        PLANS.with_borrow_mut(|plans| {
            let kept = plans.iter().position(|plan| plan.size == size).map(|at| plans.remove(at));
            let plan = kept.unwrap_or_else(|| {
                let mut planner = FourierPlanner::new();
                let (forward, inverse) = (planner.forward(size), planner.inverse(size));
                Self { size, forward, inverse }
            });
            if plans.len() == KEPT {
                plans.remove(0);
            }
            plans.push(plan.clone());
            plan
        })
    }

    /// A transform of at least `least` samples, of a size for which the transform is fast.
    pub fn smooth(least: usize) -> Self {
        Self::exact(smooth_size(least))
    }

    /// Number of samples of the signal.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Frequency of a spectral line, in Hz.
    pub fn hz(&self, line: usize, rate: f64) -> f64 {
        line as f64 * rate / self.size as f64
    }

    /// Creates a workspace for one transform.
    pub fn work(&self) -> Work {
        let scratch = self.forward.get_scratch_len().max(self.inverse.get_scratch_len());
        Work {
            signal: self.forward.make_input_vec(),
            lines: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// Transforms a signal, zero beyond its end, into `work.lines`, size / 2 + 1 lines from 0 Hz.
    pub fn forward(&self, signal: &[f64], work: &mut Work) {
        let given = signal.len().min(self.size);
        work.signal[..given].copy_from_slice(&signal[..given]);
        work.signal[given..].fill(0.0);
        self.forward_in(&mut work.signal, &mut work.lines, &mut work.scratch);
    }

    /// Transforms the `size` samples of `signal` into `lines`, size / 2 + 1 of them; `signal` is overwritten.
    pub fn forward_in(&self, signal: &mut [f64], lines: &mut [Complex<f64>], scratch: &mut [Complex<f64>]) {
        let done = self.forward.process_with_scratch(signal, lines, scratch);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
    }

    /// Inverse transform of `work.lines` into `work.signal`, without the factor 1/`size`.
    pub fn inverse(&self, work: &mut Work) {
        self.inverse_in(&mut work.lines, &mut work.signal, &mut work.scratch);
    }

    /// Inverse transform of `lines` into the `size` samples of `signal`, without the factor 1/`size`: after a forward transform, `size`
    /// times the original signal. `lines` are overwritten.
    pub fn inverse_in(&self, lines: &mut [Complex<f64>], signal: &mut [f64], scratch: &mut [Complex<f64>]) {
        // The lines at 0 and at half the rate are their own mirror images: real.
        if let Some(first) = lines.first_mut() {
            first.im = 0.0;
        }
        if let Some(last) = lines.last_mut().filter(|_| self.size.is_multiple_of(2)) {
            last.im = 0.0;
        }
        let done = self.inverse.process_with_scratch(lines, signal, scratch);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
    }

    /// Number of lines of the two-sided spectrum that a line of the one-sided spectrum represents: 1 or 2.
    pub fn copies(&self, line: usize) -> f64 {
        if line == 0 || 2 * line == self.size { 1.0 } else { 2.0 }
    }
}

/// `e^{j step k}` for `k` = `first`, `first` + 1, …: the phase factors of spectral lines for a shift of the
/// signal in time.
///
/// Each is the one before times `e^{j step}`, which takes a tenth of the time of a sine and a cosine; every [`AFRESH`] lines one is
/// computed anew, so that rounding adds up to 1e-14 at most, besides that of the angle.
pub(super) fn turns(step: f64, first: usize) -> Turns {
    Turns { step, line: first, now: Complex::cis(step * first as f64), by: Complex::cis(step) }
}

/// Number of lines after which a phase factor is computed anew.
const AFRESH: usize = 64;

/// Iterator over phase factors; see [`turns`].
pub(super) struct Turns {
    step: f64,
    line: usize,
    now: Complex<f64>,
    by: Complex<f64>,
}

impl Iterator for Turns {
    type Item = Complex<f64>;

    fn next(&mut self) -> Option<Complex<f64>> {
        let now = self.now;
        self.line += 1;
        let afresh = self.line.is_multiple_of(AFRESH);
        self.now = if afresh { Complex::cis(self.step * self.line as f64) } else { now * self.by };
        Some(now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_sines_and_cosines() {
        for step in [0.0, 1e-9, 0.7, -2.9] {
            for (k, turn) in turns(step, 37).take(5000).enumerate() {
                let angle = step * (37 + k) as f64;
                let off = (turn.re - angle.cos()).abs().max((turn.im - angle.sin()).abs());
                // The angle that the truth is computed from is itself rounded.
                assert!(off < 3e-14 + f64::EPSILON * angle.abs(), "{step} {k}: {off:e}");
            }
        }
    }

    #[test]
    fn plans_that_are_kept_are_those_of_their_size() {
        for size in (1..40).chain(1..40) {
            let plan = Transform::exact(size);
            assert_eq!((plan.size(), plan.work().signal.len()), (size, size));
        }
    }
}
