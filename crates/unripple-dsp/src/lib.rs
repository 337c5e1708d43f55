//! Signal processing: synthesis of modal responses, spectra, convolution, resampling, the vibrotactile detection threshold.

mod convolve;
mod error;
mod integral;
mod interpolate;
mod kernel;
mod resample;
mod special;
mod spectrum;
mod statistics;
mod synth;
mod threshold;
mod weighting;

pub use convolve::{Convolver, convolve, smooth_size};
pub use error::DspError;
pub use integral::integral;
pub use realfft::num_complex::Complex;
pub use resample::resample;
pub use special::{bessel_i0, bessel_j, kaiser, sinc};
pub use spectrum::{band_energies, share_above};
pub use statistics::{mean_square, median, rms};
pub use synth::ModalSynth;
pub use threshold::Threshold;
pub use weighting::Weighting;
