//! Average of repeated recordings, without outliers.

use super::same;
use unripple_dsp::{DspError, mean_square};

/// Criteria by which repeats are left out of an [`Average`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outliers {
    /// A repeat is left out if its rms difference from the median signal exceeds this many times the usual
    /// one, which is the median over all repeats.
    pub times: f64,
    /// Smallest rms difference from the median signal, as a share of that signal's rms, at which a repeat
    /// may be left out.
    pub least: f64,
}

impl Default for Outliers {
    /// A limit of three times, and of at least 1e-6 of the median's rms.
    fn default() -> Self {
        Self { times: 3.0, least: 1e-6 }
    }
}

/// The mean of repeats of one signal, with estimates of the power of signal and noise.
///
/// ```
/// use unripple_calibrate::signals::{Average, Outliers};
///
/// let good = [1.0, -1.0, 0.5, 0.0];
/// let knocked = [1.0, -1.0, 0.5, 40.0];
/// let average = Average::of(&[&good, &good, &knocked, &good], Outliers::default())?;
/// assert_eq!(average.kept, [true, true, false, true]);
/// assert_eq!(average.mean, good);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Average {
    /// Mean over the repeats that are not left out, sample by sample.
    pub mean: Vec<f64>,
    /// Whether each repeat is part of the mean; outliers are not.
    pub kept: Vec<bool>,
    /// Correlation of each repeat with the median signal of all, from −1 to 1; 0 for silence.
    pub correlations: Vec<f64>,
    /// Mean square of the noise in one repeat, estimated without bias; NaN if the mean is that of a single
    /// repeat.
    pub noise: f64,
    /// Mean square of the signal without noise, estimated without bias, at least 0; NaN if the mean is that
    /// of a single repeat.
    pub signal: f64,
}

impl Average {
    /// The average of repeats, which must have equal numbers of samples. With fewer than three, none is an
    /// outlier.
    ///
    /// # Errors
    /// [`DspError::Size`] without repeats, or if their lengths differ.
    pub fn of(repeats: &[&[f64]], outliers: Outliers) -> Result<Self, DspError> {
        let Some(samples) = repeats.first().map(|first| first.len()) else {
            return Err(DspError::Size { what: "repeats to average", expected: 1, found: 0 });
        };
        repeats.iter().try_for_each(|repeat| same("samples of a repeat", samples, repeat.len()))?;
        let centre = medians(repeats, samples);
        let spreads: Vec<f64> = repeats.iter().map(|repeat| distance(repeat, &centre)).collect();
        let usual = median(&mut spreads.clone());
        let limit = (outliers.times * usual).max(outliers.least * mean_square(&centre).sqrt());
        // A repeat with a sample that is not a number differs by NaN, which is not within the limit.
        let kept: Vec<bool> = spreads.iter().map(|spread| repeats.len() < 3 || *spread <= limit).collect();
        let chosen = || repeats.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(repeat, _)| *repeat);
        let count = chosen().count();
        let mut mean = vec![0.0; samples];
        for repeat in chosen() {
            mean.iter_mut().zip(repeat).for_each(|(sum, x)| *sum += x / count as f64);
        }
        let (noise, signal) = if count > 1 {
            let scatter: f64 = chosen().map(|repeat| distance(repeat, &mean).powi(2)).sum();
            let noise = scatter / (count - 1) as f64;
            (noise, (mean_square(&mean) - noise / count as f64).max(0.0))
        } else {
            (f64::NAN, f64::NAN)
        };
        let correlations = repeats.iter().map(|repeat| correlation(repeat, &centre)).collect();
        Ok(Self { mean, kept, correlations, noise, signal })
    }

    /// Signal-to-noise ratio of the mean, in dB. That of one repeat is less by 10 log10 of the number of
    /// repeats in the mean.
    pub fn snr_db(&self) -> f64 {
        let count = self.kept.iter().filter(|kept| **kept).count();
        10.0 * (self.signal * count as f64 / self.noise).log10()
    }

    /// Coherence of the repeats: share of the power of one repeat that all have in common, without noise and varying
    /// distortion, estimated without bias.
    pub fn coherence(&self) -> f64 {
        let whole = self.signal + self.noise;
        if whole > 0.0 { self.signal / whole } else { f64::NAN }
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    (sum / a.len().max(1) as f64).sqrt()
}

/// Correlation: the inner product divided by both norms.
pub(super) fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let norms = (mean_square(a) * mean_square(b)).sqrt() * a.len().max(1) as f64;
    if norms > 0.0 { product / norms } else { 0.0 }
}

/// Median of the repeats at each sample.
fn medians(repeats: &[&[f64]], samples: usize) -> Vec<f64> {
    let mut column = vec![0.0; repeats.len()];
    (0..samples)
        .map(|i| {
            column.iter_mut().zip(repeats).for_each(|(to, repeat)| *to = repeat[i]);
            median(&mut column)
        })
        .collect()
}

/// The median: the middle value, or the mean of the two middle ones; 0 without values.
pub(super) fn median(values: &mut [f64]) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    match values.len() {
        0 => 0.0,
        n if n % 2 == 1 => values[n / 2],
        n => (values[n / 2 - 1] + values[n / 2]) / 2.0,
    }
}
