//! Signal processing: synthesis of modal responses, spectra, convolution, resampling, the vibrotactile detection threshold, A-weighting.
//!
//! Signals are slices of samples and modes are poles; surfaces, targets and devices are not known here. What only
//! measurements need (sweeps, deconvolution, quality of responses) is in `unripple-calibrate`, what runs in real time in
//! `unripple-player`.
//!
//! # In reading order
//!
//! [`ModalSynth`] computes impulse responses from the poles of modes. A [`Convolver`] keeps the Fourier transforms of
//! signals that are convolved several times, [`convolve()`] does one convolution, [`resample()`] changes the sample rate. A
//! [`Threshold`] is the displacement that a fingertip just feels, against frequency, and a [`Weighting`] is the filter
//! that expresses a displacement in multiples of it. [`RateOfChange`] and [`a_weighting()`] are for
//! sound pressure. [`Complex`] is the type of spectra, a [`FourierPlanner`] plans their transforms; the other functions are small.
//!
//! ```
//! use unripple_core::Pole;
//! use unripple_dsp::{ModalSynth, convolve};
//! use unripple_linalg::mat;
//!
//! // The impulse response of three modes, 50 ms of it.
//! let poles = [Pole::new(1000.0, 14.0), Pole::new(2300.0, 14.0), Pole::new(3700.0, 14.0)];
//! let synth = ModalSynth::new(&poles, 8000.0, 401, 1e-6);
//! let mut response = vec![0.0; 401];
//! synth.respond(mat![[1.0, -0.6, 0.4]].as_ref(), &mut response)?;
//! // Time reversal: played backwards into the same system, it gives its largest output, its energy, at its last sample.
//! let reversed: Vec<f64> = response.iter().rev().copied().collect();
//! let output = convolve(&reversed, &response);
//! let energy: f64 = response.iter().map(|h| h * h).sum();
//! assert!((output[400] - energy).abs() < 1e-9 * energy);
//! assert!(output.iter().enumerate().all(|(i, v)| i == 400 || v.abs() < output[400]));
//! # Ok::<(), unripple_dsp::DspError>(())
//! ```

mod convolve;
mod correlations;
mod error;
mod fourier;
mod integral;
mod interpolate;
mod kernel;
mod resample;
mod sound;
mod special;
mod spectrum;
mod statistics;
mod synth;
mod threshold;
mod weighting;

pub use convolve::{Convolver, convolve, smooth_size};
pub use correlations::Correlations;
pub use error::DspError;
pub use fourier::{FourierPlanner, forward_single, inverse_single};
pub use integral::integral;
pub use realfft::num_complex::Complex;
pub use realfft::{ComplexToReal, RealToComplex};
pub use resample::resample;
pub use sound::{REFERENCE_PRESSURE, RateOfChange, a_weighting};
pub use special::{bessel_i0, bessel_j, kaiser, sinc};
pub use spectrum::{band_energies, share_above};
pub use statistics::{mean_square, median, rms};
pub use synth::ModalSynth;
pub use threshold::Threshold;
pub use weighting::Weighting;
