//! Spectral lines of a band, on which recordings are compared with predictions.

use crate::CalibrateError;
use crate::signals::Band;
use std::f64::consts::TAU;
use unripple_core::require;
use unripple_dsp::{Complex, Convolver, smooth_size};

/// The spectrum of a signal on the lines of a band.
pub(super) type Spectrum = Vec<Complex<f64>>;

/// Length of the Fourier transform relative to that of the recordings, so that a delayed end does not wrap into the
/// beginning. Longer ones have more lines, which cost time and tell nothing more.
const PADDED: f64 = 1.25;

/// Spectral lines of a band for recordings of one length.
#[derive(Debug)]
pub struct Lines {
    plan: Convolver,
    rate: f64,
    /// Weight of each line, so that the sum of the squares of a weighted spectrum is that of the signal in the band.
    weights: Vec<f64>,
}

impl Lines {
    /// Lines for recordings of `samples` samples at `rate` samples per second, in a band.
    ///
    /// # Errors
    /// [`CalibrateError::Range`] and [`CalibrateError::Dsp`] for a rate or a band out of range,
    /// [`CalibrateError::Count`] for no samples.
    pub fn new(samples: usize, rate: f64, band: Band) -> Result<Self, CalibrateError> {
        require("sample rate in Hz", rate > 0.0 && rate.is_finite(), "a positive number", rate)?;
        band.check()?;
        if samples == 0 {
            let (what, expected) = ("samples of the recordings", "at least 1".to_owned());
            return Err(CalibrateError::Count { what, expected, found: 0 });
        }
        let plan = Convolver::new(smooth_size((PADDED * samples as f64) as usize));
        let size = plan.size();
        let hz = |line: usize| line as f64 * rate / size as f64;
        // A line stands for its mirror image, too.
        let copies = |line: usize| if line == 0 || 2 * line == size { 1.0_f64 } else { 2.0 };
        let weight = |line: usize| band.weight(hz(line)) * (copies(line) / size as f64).sqrt();
        let count = (0..=size / 2).take_while(|line| hz(*line) <= band.high[1]).count();
        Ok(Self { weights: (0..count).map(weight).collect(), plan, rate })
    }

    /// Number of lines, from 0 Hz to the top of the band.
    pub(super) fn count(&self) -> usize {
        self.weights.len()
    }

    /// Sample rate of the recordings, in Hz.
    pub(super) fn rate(&self) -> f64 {
        self.rate
    }

    /// Angle by which a line turns in a sample, in radians.
    pub(super) fn turn(&self, line: usize) -> f64 {
        TAU * line as f64 / self.plan.size() as f64
    }

    /// Weight of a line.
    pub(super) fn weight(&self, line: usize) -> f64 {
        self.weights[line]
    }

    /// The spectrum of a signal, without weights.
    pub(super) fn plain(&self, signal: &[f64]) -> Spectrum {
        let mut spectrum = self.plan.spectrum(signal.iter().copied());
        spectrum.truncate(self.count());
        spectrum
    }

    /// The spectrum of a signal, weighted by the band.
    pub(super) fn weighted(&self, signal: &[f64]) -> Spectrum {
        self.plain(signal).iter().zip(&self.weights).map(|(x, weight)| x * weight).collect()
    }

    /// The periodic signal that a spectrum on these lines stands for, up to a factor.
    pub(super) fn signal(&self, spectrum: &[Complex<f64>]) -> Vec<f64> {
        let mut all = vec![Complex::default(); self.plan.size() / 2 + 1];
        all.iter_mut().zip(spectrum).for_each(|(to, from)| *to = *from);
        self.plan.signal(all)
    }
}
