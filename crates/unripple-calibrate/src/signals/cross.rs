//! The H1 estimator: frequency responses from averaged cross and power spectra, with coherence.

use super::transform::{Transform, Work};
use super::{Band, Inversion, positive, same};
use std::f64::consts::TAU;
use unripple_dsp::{Complex, DspError};

/// Summed spectra of repeats of a drive and its recording: for drives that differ from repeat to repeat
/// (taps), and for a reference channel, which records the drive after converters and amplifiers.
///
/// The response is the least-squares one, `H = rate · Σ V D* / (Σ |D|² + ε)`, and the coherence the share of the
/// recording's power that follows the drive linearly.
///
/// Source: J. S. Bendat, A. G. Piersol, "Random Data" (2010), section 6.1 (optimum frequency response, ordinary
/// coherence).
///
/// ```
/// use unripple_calibrate::signals::{CrossSpectra, Inversion};
///
/// let mut taps = CrossSpectra::new(64, 48e3)?;
/// for (strength, width) in [(1.0, 0.5), (2.0, 0.3)] {
///     let force = [strength, strength * width];
///     let heard = [0.0, 3.0 * force[0], 3.0 * force[1]]; // three times the force, a sample later
///     taps.add(&force, &heard)?;
/// }
/// let mut response = [0.0; 4];
/// taps.response(&Inversion::default(), &mut response)?;
/// assert!((response[1] / 48e3 - 3.0).abs() < 1e-6 && response[2].abs() < 1e-2);
/// assert!(taps.coherence().iter().all(|share| (share - 1.0).abs() < 1e-9));
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
pub struct CrossSpectra {
    plan: Transform,
    samples: usize,
    rate: f64,
    count: usize,
    cross: Vec<Complex<f64>>,
    drive: Vec<f64>,
    heard: Vec<f64>,
    works: [Work; 2],
}

impl CrossSpectra {
    /// Empty sums for repeats whose drive and recording each have at most `samples` samples, silence
    /// included; `rate` is in samples per second.
    ///
    /// # Errors
    /// [`DspError::Size`] for 0 samples, [`DspError::Range`] if `rate` is not positive.
    pub fn new(samples: usize, rate: f64) -> Result<Self, DspError> {
        positive("samples per second", rate)?;
        if samples == 0 {
            return Err(DspError::Size { what: "samples of a repeat", expected: 1, found: 0 });
        }
        let plan = Transform::smooth(samples);
        let works = [plan.work(), plan.work()];
        let lines = works[0].lines.len();
        Ok(Self {
            plan,
            samples,
            rate,
            count: 0,
            cross: vec![Complex::default(); lines],
            drive: vec![0.0; lines],
            heard: vec![0.0; lines],
            works,
        })
    }

    /// Adds a repeat, a drive and its recording, both sampled at the planned rate and zero beyond their ends.
    ///
    /// # Errors
    /// [`DspError::Size`] if either is longer than planned.
    pub fn add(&mut self, drive: &[f64], heard: &[f64]) -> Result<(), DspError> {
        for (signal, work) in [drive, heard].into_iter().zip(&mut self.works) {
            if signal.len() > self.samples {
                same("samples of a repeat", self.samples, signal.len())?;
            }
            self.plan.forward(signal, work);
        }
        let [d, v] = &self.works;
        for (line, (d, v)) in d.lines.iter().zip(&v.lines).enumerate() {
            self.cross[line] += v * d.conj();
            self.drive[line] += d.norm_sqr();
            self.heard[line] += v.norm_sqr();
        }
        self.count += 1;
        Ok(())
    }

    /// Number of repeats added so far.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Estimates the response, limited to a band and regularised as by [`super::Deconvolver`]. `inversion.band` should be
    /// the band in which the drives have power; `None` means all frequencies. The first samples are written to `response`,
    /// in the unit of the recording per unit of drive and second.
    ///
    /// # Errors
    /// [`DspError::Size`] if `response` is longer than the plan; [`DspError::Range`] for a band whose edges do not
    /// ascend, or in which the drives were silent.
    pub fn response(&mut self, inversion: &Inversion, response: &mut [f64]) -> Result<(), DspError> {
        let (size, band) = (self.plan.size(), inversion.band.unwrap_or(Band::ALL));
        band.check()?;
        if response.len() > size {
            same("samples of a response", size, response.len())?;
        }
        let weights: Vec<f64> =
            (0..self.drive.len()).map(|line| band.weight(self.plan.hz(line, self.rate))).collect();
        let inside = self.drive.iter().zip(&weights).filter(|(_, weight)| **weight > 0.0);
        let most = inside.map(|(power, _)| *power).fold(0.0, f64::max);
        positive("power of the drives in the band", most)?;
        let turn = TAU * (inversion.latency - inversion.lead as f64) / size as f64;
        let work = &mut self.works[0];
        for (line, value) in work.lines.iter_mut().enumerate() {
            let power = self.drive[line] + inversion.regularisation.max(0.0) * most;
            let scale = if power > 0.0 { self.rate * weights[line] / power / size as f64 } else { 0.0 };
            *value = self.cross[line] * Complex::from_polar(scale, turn * line as f64);
        }
        self.plan.inverse(work);
        response.copy_from_slice(&work.signal[..response.len()]);
        Ok(())
    }

    /// Coherence at each spectral line, from 0 Hz to half the rate, each from 0 to 1; 0 where drive or
    /// recording is silent. For pure noise its expectation is 1/n for n repeats, so that a single repeat
    /// gives no information.
    pub fn coherence(&self) -> Vec<f64> {
        let sums = self.cross.iter().zip(&self.drive).zip(&self.heard);
        sums.map(|((cross, drive), heard)| share(cross.norm_sqr(), drive * heard)).collect()
    }

    /// Share of the power recorded in a band that follows the drive, 0 to 1: the mean of the coherence, weighted by
    /// that power.
    pub fn coherence_in(&self, band: Band) -> f64 {
        let (mut followed, mut heard) = (0.0, 0.0);
        for (line, share) in self.coherence().into_iter().enumerate() {
            let power =
                self.heard[line] * band.weight(self.plan.hz(line, self.rate)) * self.plan.copies(line);
            followed += share * power;
            heard += power;
        }
        share(followed, heard)
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
