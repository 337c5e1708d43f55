//! Averages of repeats without outliers.

use super::same;
use unripple_dsp::{DspError, mean_square};

/// Which repeats are left out of an [`Average`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outliers {
    /// A repeat is left out if it differs from the median of all by more than this many times what they usually differ
    /// by (rms, the median over repeats).
    pub times: f64,
    /// No repeat is left out that differs from the median by less (rms) than this share of the median's rms.
    pub least: f64,
}

impl Default for Outliers {
    /// A limit of three times, and of at least 1e-6 of the median's rms.
    fn default() -> Self {
        Self { times: 3.0, least: 1e-6 }
    }
}

/// The mean of repeats of one signal, with what they say about the noise.
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
    /// Mean of the repeats kept.
    pub mean: Vec<f64>,
    /// Which repeats were kept.
    pub kept: Vec<bool>,
    /// Correlation of each repeat with the median of all, from −1 to 1; 0 for silence.
    pub correlations: Vec<f64>,
    /// Mean square of the noise in one repeat, estimated without bias; NaN if only one was kept.
    pub noise: f64,
    /// Mean square of the signal without noise, estimated without bias, at least 0; NaN if only one was kept.
    pub signal: f64,
}

impl Average {
    /// The average of repeats, which must all have as many samples. With fewer than three, none is an outlier.
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

    /// Signal-to-noise ratio of the mean, in dB. That of one repeat is less by 10 log10 of the number of repeats kept.
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

/// Inner product over the norms.
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

/// The value in the middle, or the mean of the two; 0 without values.
pub(super) fn median(values: &mut [f64]) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    match values.len() {
        0 => 0.0,
        n if n % 2 == 1 => values[n / 2],
        n => (values[n / 2 - 1] + values[n / 2]) / 2.0,
    }
}
