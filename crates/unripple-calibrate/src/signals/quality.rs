//! Quality of a measured response: signal-to-noise ratio, coherence, clipping.

use super::{Decay, onset};
use unripple_dsp::{DspError, mean_square};

/// Quality of one measured response.
///
/// ```
/// use unripple_calibrate::signals::Quality;
///
/// let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 23) - 1.0;
/// let heard: Vec<f64> =
///     (0..9600).map(|i| (f64::from(i) * 0.2).sin() * (-f64::from(i) / 960.0).exp() + 0.001 * noise(i)).collect();
/// let before: Vec<f64> = (20_000..22_000).map(|i| 0.001 * noise(i)).collect();
/// let quality = Quality::of(&heard, &before, 48e3)?;
/// assert!((quality.snr_db - 48.8).abs() < 0.5);
/// assert!((quality.decay.expect("it dies away").time - 0.02).abs() < 1e-3);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// Signal-to-noise ratio, in dB, over the whole response.
    pub snr_db: f64,
    /// Coherence, from 0 to 1: share of the recorded power that repeats have in common, or that follows the drive; `None` without
    /// repeats.
    pub coherence: Option<f64>,
    /// Total harmonic distortion relative to the linear response, in dB; `None` unless the stimulus was a sweep that separates it.
    pub distortion_db: Option<f64>,
    /// Decay of the response; `None` if it does not stand out of its noise.
    pub decay: Option<Decay>,
    /// Onset of the response, 20 dB below its peak, in samples; `None` for silence.
    pub onset: Option<f64>,
}

impl Quality {
    /// The quality of a response, from the response and from any number of samples of noise after the same
    /// deconvolution: before the response's time 0, or after it has decayed.
    ///
    /// # Errors
    /// [`DspError::Range`] if `rate` is not positive.
    pub fn of(response: &[f64], noise: &[f64], rate: f64) -> Result<Self, DspError> {
        Ok(Self {
            snr_db: snr_db(response, noise),
            coherence: None,
            distortion_db: None,
            decay: Decay::of(response, rate)?,
            onset: onset(response, 20.0)?,
        })
    }
}

/// Signal-to-noise ratio in dB, from a noisy signal and samples of noise alone, any number of them: −∞ if the signal has no more
/// power than the noise, ∞ without noise.
///
/// ```
/// assert!((unripple_calibrate::signals::snr_db(&[10.0, -10.0], &[1.0, -1.0, 1.0]) - 10.0 * 99f64.log10()).abs() < 1e-12);
/// ```
pub fn snr_db(signal: &[f64], noise: &[f64]) -> f64 {
    let (all, noise) = (mean_square(signal), mean_square(noise));
    if all > noise { 10.0 * (all / noise - 1.0).log10() } else { f64::NEG_INFINITY }
}

/// Number of clipped samples of a channel: samples in runs of four or more within a millionth of the largest
/// magnitude, and samples at `full_scale` or beyond.
///
/// ```
/// let clipped: Vec<f64> = (0..480).map(|i| (f64::from(i) * 0.05).sin().clamp(-0.9, 0.9)).collect();
/// assert!(unripple_calibrate::signals::clipped(&clipped, 1.0) > 100);
/// ```
pub fn clipped(heard: &[f64], full_scale: f64) -> usize {
    let peak = heard.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if peak <= 0.0 {
        return 0;
    }
    let at_peak = |x: f64| if x.abs() >= peak * (1.0 - 1e-6) { x.signum() } else { 0.0 };
    let flat = heard.chunk_by(|a, b| at_peak(*a) == at_peak(*b));
    let run = |run: &[f64]| run.len() >= 4 && run.first().is_some_and(|x| at_peak(*x) != 0.0);
    let beyond = |part: &[f64]| part.iter().filter(|x| x.abs() >= full_scale).count();
    flat.map(|part| if run(part) { part.len() } else { beyond(part) }).sum()
}
