//! Cosine transforms of impulse responses: real spectra of their even parts.

use crate::CalibrateError;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;
use unripple_core::{SampledResponses, require};
use unripple_dsp::{Complex, ComplexToReal, FourierPlanner, RealToComplex};
use unripple_linalg::Mat;

/// Cosine transform of responses into real spectra, and its inverse.
///
/// A response is causal, so that the transform of its even part, a real number per frequency, determines all of it.
/// Unlike the response itself its even part has no step at the impulse and, taken over a period of twice its length,
/// none at its end: what is left in a bin is waves of that frequency. It also is the part of the response without the
/// near field of the actuator (the imaginary part of the field's Green function is J0, regular at the source; Weaver
/// and Lobkis, J. Acoust. Soc. Am. 110, 2001, eq. 5), and so has J0 for its covariance.
#[derive(Clone)]
pub(crate) struct Cosines {
    samples: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

impl std::fmt::Debug for Cosines {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Cosines").field("samples", &self.samples).finish()
    }
}

impl Cosines {
    /// Transforms for responses of `samples` samples, two or more.
    pub fn new(samples: usize) -> Self {
        let mut planner = FourierPlanner::new();
        let period = 2 * (samples.max(2) - 1);
        Self { samples, forward: planner.forward(period), inverse: planner.inverse(period) }
    }

    /// Period of the even part, in samples: 2 (n - 1) for responses of n samples.
    pub fn period(&self) -> usize {
        self.forward.len()
    }

    /// Transforms the even part of a response into its first `bins.len()` bins.
    fn bins(&self, response: &[f32], bins: &mut [f64]) {
        let mut even = self.forward.make_input_vec();
        let last = self.samples - 1;
        even.iter_mut().enumerate().for_each(|(i, e)| {
            *e = f64::from(response[if i <= last { i } else { 2 * last - i }]);
        });
        let mut spectrum = self.forward.make_output_vec();
        let done = self.forward.process(&mut even, &mut spectrum);
        debug_assert!(done.is_ok(), "sizes come from the plan itself");
        bins.iter_mut().zip(spectrum).for_each(|(bin, x)| *bin = x.re);
    }

    /// Inverse transform: writes to `response` the samples of the response whose even part has the spectrum `bins`, from 0 Hz on.
    /// Bins beyond these count as 0.
    pub fn response(&self, bins: impl Iterator<Item = f64>, response: &mut [f32]) {
        let mut spectrum = self.inverse.make_input_vec();
        spectrum.iter_mut().zip(bins).for_each(|(x, bin)| *x = Complex::new(bin, 0.0));
        let mut even = self.inverse.make_output_vec();
        let done = self.inverse.process(&mut spectrum, &mut even);
        debug_assert!(done.is_ok(), "real spectra have real ends");
        let scale = 1.0 / self.period() as f64;
        response.iter_mut().zip(even).for_each(|(h, e)| *h = (e * scale) as f32);
    }
}

/// The cosine spectra of many responses, up to a highest frequency.
#[derive(Clone, Debug)]
pub(crate) struct Spectra {
    /// Cosine transforms, forward and inverse.
    pub cosines: Cosines,
    /// Distance between frequency bins, in Hz.
    pub step: f64,
    /// Number of actuators.
    pub actuators: usize,
    /// Spectra of the responses' even parts, `[bin][point][actuator]`.
    pub values: Vec<f64>,
    /// Mean square of `values` over all points, `[bin][actuator]`.
    pub powers: Vec<f64>,
    /// Mean square of all samples of all responses.
    pub square: f64,
}

impl Spectra {
    /// Spectra of `responses` from 0 Hz up to `top` times the top of the band. A raised cosine fades them out over the upper
    /// half of the range above the band.
    ///
    /// # Errors
    /// [`CalibrateError::Count`] without points or actuators, or for fewer than two samples; [`CalibrateError::Range`] for a
    /// sample rate that is not positive, a band whose top is not between 0 and half the sample rate, or a coordinate or sample
    /// that is not finite.
    pub fn of(responses: &SampledResponses, top: f64) -> Result<Self, CalibrateError> {
        check(responses)?;
        let conditions = &responses.conditions;
        let cosines = Cosines::new(responses.samples());
        let step = conditions.rate / cosines.period() as f64;
        let ends = [(1.0 + top) / 2.0, top].map(|factor| factor * conditions.band[1]);
        let bins = ((ends[1] / step).floor() as usize + 1).min(responses.samples());
        let (points, actuators) = (responses.points.len(), responses.ports.len());
        let mut rows = vec![0.0; points * actuators * bins];
        rows.par_chunks_mut(bins).enumerate().for_each(|(row, bins)| {
            cosines.bins(responses.response(row % actuators, row / actuators), bins);
            bins.iter_mut().enumerate().for_each(|(bin, x)| *x *= taper(bin as f64 * step, ends));
        });
        let width = points * actuators;
        let mut values = vec![0.0; rows.len()];
        values.par_chunks_mut(width).enumerate().for_each(|(bin, values)| {
            values.iter_mut().enumerate().for_each(|(row, x)| *x = rows[row * bins + bin]);
        });
        let mut powers = vec![0.0; bins * actuators];
        for (power, values) in powers.chunks_mut(actuators).zip(values.chunks(width)) {
            let share = 1.0 / points as f64;
            values.chunks(actuators).for_each(|row| {
                power.iter_mut().zip(row).for_each(|(p, x)| *p += x * x * share);
            });
        }
        let square = mean_square(responses)?;
        Ok(Self { cosines, step, actuators, values, powers, square })
    }

    /// Number of frequency bins, from 0 Hz up to the highest frequency.
    pub fn bins(&self) -> usize {
        self.powers.len() / self.actuators
    }

    /// Mean square of the spectra at a frequency bin over all points and actuators.
    pub fn power(&self, bin: usize) -> f64 {
        let row = &self.powers[bin * self.actuators..][..self.actuators];
        row.iter().sum::<f64>() / self.actuators as f64
    }

    /// Values of a frequency bin at some points, points x actuators, scaled for each actuator so that the
    /// mean square over all points and the bins `around` is `square`.
    pub fn normalised(&self, bin: usize, around: Range<usize>, points: &[usize], square: f64) -> Mat<f64> {
        let (bins, width) = (around.len() as f64, self.values.len() / self.bins());
        let unit: Vec<f64> = (0..self.actuators)
            .map(|a| {
                let power = around.clone().map(|bin| self.powers[bin * self.actuators + a]).sum::<f64>();
                (square * bins / power.max(f64::MIN_POSITIVE)).sqrt()
            })
            .collect();
        Mat::from_fn(points.len(), self.actuators, |p, a| {
            unit[a] * self.values[bin * width + points[p] * self.actuators + a]
        })
    }
}

/// Weight of a frequency: 1 up to the first end, 0 from the second, a raised cosine between.
fn taper(hz: f64, [from, to]: [f64; 2]) -> f64 {
    if hz <= from { 1.0 } else { 0.5 + 0.5 * (PI * ((hz - from) / (to - from)).min(1.0)).cos() }
}

fn mean_square(responses: &SampledResponses) -> Result<f64, CalibrateError> {
    let actuators = responses.ports.len();
    let squares: Vec<f64> = (0..responses.points.len() * actuators)
        .into_par_iter()
        .map(|row| {
            let response = responses.response(row % actuators, row / actuators);
            response.iter().map(|h| f64::from(*h).powi(2)).sum::<f64>()
        })
        .collect();
    if let Some(row) = squares.iter().position(|square| !square.is_finite()) {
        let what = format!("response of point {} to actuator {}", row / actuators + 1, row % actuators + 1);
        require(what, false, "finite samples", squares[row])?;
    }
    Ok(squares.iter().sum::<f64>() / (squares.len() * responses.samples()) as f64)
}

fn check(responses: &SampledResponses) -> Result<(), CalibrateError> {
    let counts = [
        ("points with responses", 1, responses.points.len()),
        ("actuators", 1, responses.ports.len()),
        ("samples of a response", 2, responses.samples()),
    ];
    for (what, least, found) in counts {
        if found < least {
            return Err(CalibrateError::Count { what, expected: format!("at least {least}"), found });
        }
    }
    if let Some(index) = responses.points.iter().position(|point| !point.is_finite()) {
        let found = responses.points[index].x + responses.points[index].y;
        require(format!("point {} (m)", index + 1), false, "finite coordinates", found)?;
    }
    let (rate, band) = (responses.conditions.rate, responses.conditions.band);
    let positive = |x: f64| x.is_finite() && x > 0.0;
    require("sample rate (Hz)", positive(rate), "a positive number", rate)?;
    let below = positive(band[1]) && band[1] <= rate / 2.0;
    Ok(require("top of the band (Hz)", below, "more than 0, at most half the sample rate", band[1])?)
}
