//! Signal processing: synthesis of modal responses, spectra, convolution, the threshold of touch, measuring responses.

mod convolve;
mod error;
mod integral;
mod interpolate;
mod kernel;
mod measure;
mod resample;
mod special;
mod spectrum;
mod synth;
mod threshold;
mod weighting;

pub use convolve::{Convolver, convolve};
pub use error::DspError;
pub use integral::integral;
pub use measure::{
    Average, Band, CrossSpectra, Decay, Deconvolver, Delay, Gate, Harmonic, Harmonics, Inversion,
    Outliers, Pair, Quality, Reciprocity, Remap, Schedule, Split, Stimulus, Sweep, Workspace, band_powers,
    clipped, onset, shift, snr_db,
};
pub use realfft::num_complex::Complex;
pub use resample::resample;
pub use special::{bessel_i0, bessel_j, kaiser, sinc};
pub use spectrum::{band_energies, share_above};
pub use synth::ModalSynth;
pub use threshold::Threshold;
pub use weighting::Weighting;
