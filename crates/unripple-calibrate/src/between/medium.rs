//! Covariance of the wave field between points, from the sheet's wavenumber at each frequency, for kriging.

use super::bessel::Bessel;
use super::options::BetweenOptions;
use super::spectra::Spectra;
use crate::CalibrateError;
use std::f64::consts::TAU;
use unripple_core::require;

/// Largest wavenumber in the nugget, as a multiple of the wavenumber of the dispersion relation. A larger multiple
/// makes the nugget more like noise that differs from point to point, a smaller one more like the field itself.
const NUGGET: f64 = 1.5;

/// Smallest power of the errors of a response, relative to the power of the field: well above the interpolation
/// errors of the tables of covariances.
const LEAST: f64 = 1e-6;

/// Covariance model of the wave field at one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpectralLine {
    /// Wavenumber, in rad/m.
    pub k: f64,
    /// Largest wavenumber of the nugget's waves (those of wavenumbers other than `k`), in rad/m.
    pub stray_k: f64,
    /// Share (0 to 1) of the field's power in the nugget: waves of wavenumbers other than `k`.
    pub nugget: f64,
    /// Power of the errors of a response at one point, relative to the power of the field. Errors at different points
    /// are independent.
    pub error: f64,
    /// Factor, at most 1, by which errors of the points' positions reduce the field's covariance.
    pub kept: f64,
}

/// Covariance models of the wave field at all frequency bins.
#[derive(Clone, Debug)]
pub(crate) struct Waves {
    /// One model for each bin of the spectra, frequencies ascending.
    pub lines: Vec<SpectralLine>,
    bessel: Bessel,
}

impl Waves {
    /// Covariance models for the bins of `spectra`. `wavenumber` gives k (rad/m) at an angular frequency (rad/s);
    /// the nugget has waves of all wavenumbers up to a limit above k, which is never below `floor` (rad/m); `reach` is
    /// the largest distance (m) between two places.
    ///
    /// # Errors
    /// [`CalibrateError::Range`] for a wavenumber that is negative, or 1e7 rad/m or more.
    pub fn of(
        spectra: &Spectra,
        wavenumber: impl Fn(f64) -> f64,
        floor: f64,
        reach: f64,
        options: &BetweenOptions,
    ) -> Result<Self, CalibrateError> {
        let mut lines = Vec::with_capacity(spectra.bins());
        // A cosine transform doubles what is not at its ends; noise adds by power.
        let noise = options.noise.powi(2) * spectra.square * spectra.cosines.period() as f64;
        let loudest = (0..spectra.bins()).map(|bin| spectra.power(bin)).fold(f64::MIN_POSITIVE, f64::max);
        for bin in 0..spectra.bins() {
            let hz = bin as f64 * spectra.step;
            let k = wavenumber(TAU * hz);
            require(
                format!("wavenumber at {hz:.1} Hz (rad/m)"),
                (0.0..1e7).contains(&k),
                "0 or more, finite",
                k,
            )?;
            let field = (spectra.power(bin) - noise).max(1e-3 * noise).max(1e-12 * loudest);
            let moved = (k * options.position_error).powi(2) / 2.0;
            lines.push(SpectralLine {
                k,
                stray_k: (NUGGET * k).max(floor),
                nugget: options.nugget,
                error: (noise / field + options.gain_error.powi(2) + moved.exp_m1()).max(LEAST),
                kept: (-moved / 2.0).exp(),
            });
        }
        let most = lines.iter().fold(0.0, |most: f64, line| most.max(line.stray_k));
        Ok(Self { lines, bessel: Bessel::up_to((most * reach).min(1e5)) })
    }

    /// Covariance of the field at two places a distance (m) apart, relative to the field's power: a ratio.
    pub fn covariance(&self, line: &SpectralLine, distance: f64) -> f64 {
        let ring = self.bessel.ring(line.k * distance);
        if line.nugget == 0.0 {
            return ring;
        }
        ring + line.nugget * (self.bessel.disc(line.stray_k * distance) - ring)
    }

    /// Derivative of [`Waves::covariance`] by the share of stray waves, those of wavenumbers other than the
    /// sheet's: a ratio.
    pub fn stray(&self, line: &SpectralLine, distance: f64) -> f64 {
        self.bessel.disc(line.stray_k * distance) - self.bessel.ring(line.k * distance)
    }
}
