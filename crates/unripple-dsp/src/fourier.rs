//! Plans of fast Fourier transforms of real signals.
//!
//! The library's planner is generic code: whoever calls it compiles all its transforms again, a fifth of what a crate above this one would
//! then have to compile. Here it is called for all of them, by functions that are compiled once.

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::sync::Arc;

/// Plans transforms of 64-bit samples, and makes the plan of one size once.
///
/// ```
/// use unripple_dsp::FourierPlanner;
///
/// let plan = FourierPlanner::new().forward(4);
/// let (mut signal, mut spectrum) = (vec![1.0, 0.0, 0.0, 0.0], plan.make_output_vec());
/// plan.process(&mut signal, &mut spectrum).unwrap();
/// // An impulse has all frequencies, from 0 to half the sample rate.
/// assert!(spectrum.len() == 3 && spectrum.iter().all(|value| (value.re - 1.0).hypot(value.im) < 1e-15));
/// ```
pub struct FourierPlanner(RealFftPlanner<f64>);

impl FourierPlanner {
    /// A planner that has made no plan yet.
    #[must_use]
    #[inline(never)]
    pub fn new() -> Self {
        Self(RealFftPlanner::new())
    }

    /// The plan that takes `size` samples to the `size / 2 + 1` values of their spectrum, without scaling.
    #[inline(never)]
    pub fn forward(&mut self, size: usize) -> Arc<dyn RealToComplex<f64>> {
        self.0.plan_fft_forward(size)
    }

    /// The plan that takes the `size / 2 + 1` values of a spectrum to `size` samples, without scaling: forward and back multiply by `size`.
    #[inline(never)]
    pub fn inverse(&mut self, size: usize) -> Arc<dyn ComplexToReal<f64>> {
        self.0.plan_fft_inverse(size)
    }
}

impl Default for FourierPlanner {
    fn default() -> Self {
        Self::new()
    }
}

/// The plan of [`FourierPlanner::forward`] for 32-bit samples, in which sound is played.
#[must_use]
#[inline(never)]
pub fn forward_single(size: usize) -> Arc<dyn RealToComplex<f32>> {
    RealFftPlanner::new().plan_fft_forward(size)
}

/// The plan of [`FourierPlanner::inverse`] for 32-bit samples, in which sound is played.
#[must_use]
#[inline(never)]
pub fn inverse_single(size: usize) -> Arc<dyn ComplexToReal<f32>> {
    RealFftPlanner::new().plan_fft_inverse(size)
}
