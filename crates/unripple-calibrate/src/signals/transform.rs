//! Real fast Fourier transforms of one size, with their scratch.

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::sync::Arc;
use unripple_dsp::smooth_size;

/// Fourier transforms of real signals of one size, without scaling either way.
#[derive(Clone)]
pub(super) struct Transform {
    size: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

/// Where one transform works.
pub(super) struct Work {
    /// The signal.
    pub signal: Vec<f64>,
    /// Its spectrum, from 0 to half the rate.
    pub lines: Vec<Complex<f64>>,
    /// For the transform itself.
    pub scratch: Vec<Complex<f64>>,
}

impl std::fmt::Debug for Transform {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transform").field("size", &self.size).finish()
    }
}

impl Transform {
    /// Of exactly so many samples, at least one.
    pub fn exact(size: usize) -> Self {
        let size = size.max(1);
        let mut planner = RealFftPlanner::new();
        Self { size, forward: planner.plan_fft_forward(size), inverse: planner.plan_fft_inverse(size) }
    }

    /// Of at least so many samples, where transforms are quick.
    pub fn smooth(least: usize) -> Self {
        Self::exact(smooth_size(least))
    }

    pub fn size(&self) -> usize {
        self.size
    }

    /// Frequency of a line, in Hz.
    pub fn hz(&self, line: usize, rate: f64) -> f64 {
        line as f64 * rate / self.size as f64
    }

    pub fn work(&self) -> Work {
        let scratch = self.forward.get_scratch_len().max(self.inverse.get_scratch_len());
        Work {
            signal: self.forward.make_input_vec(),
            lines: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// The spectrum of a signal, zero beyond its end, into `work.lines`.
    pub fn forward(&self, signal: &[f64], work: &mut Work) {
        let given = signal.len().min(self.size);
        work.signal[..given].copy_from_slice(&signal[..given]);
        work.signal[given..].fill(0.0);
        self.forward_in(&mut work.signal, &mut work.lines, &mut work.scratch);
    }

    /// The spectrum of `signal`, which is spoilt.
    pub fn forward_in(&self, signal: &mut [f64], lines: &mut [Complex<f64>], scratch: &mut [Complex<f64>]) {
        let done = self.forward.process_with_scratch(signal, lines, scratch);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
    }

    /// The signal of `work.lines`, `size` times as large, into `work.signal`.
    pub fn inverse(&self, work: &mut Work) {
        self.inverse_in(&mut work.lines, &mut work.signal, &mut work.scratch);
    }

    /// The signal of `lines`, which are spoilt, `size` times as large.
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

    /// How many lines of the two-sided spectrum a line stands for.
    pub fn copies(&self, line: usize) -> f64 {
        if line == 0 || 2 * line == self.size { 1.0 } else { 2.0 }
    }
}
