//! Covariance of the waves between points: kriging with the sheet's own waves as the covariance.

use super::bessel::Bessel;
use super::options::BetweenOptions;
use super::spectra::Spectra;
use crate::CalibrateError;
use std::f64::consts::TAU;
use unripple_core::require;

/// The waves of the nugget have any wavenumber up to this multiple of the one given by the dispersion relation. A
/// wider disc makes the nugget more like noise that differs from point to point, a narrower one more like the field
/// itself.
const NUGGET: f64 = 1.5;

/// Least power of the errors of a response over its own power: well above what the tables of covariances are off by.
const LEAST: f64 = 1e-6;

/// Waves of one frequency as the points see them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpectralLine {
    /// Wavenumber, in rad/m.
    pub k: f64,
    /// Largest wavenumber of the nugget's waves, in rad/m.
    pub stray_k: f64,
    /// Share of the power in the nugget: waves of other wavenumbers.
    pub nugget: f64,
    /// Power of the errors at one point, independent of other points', over that of the field.
    pub error: f64,
    /// Factor by which errors of position weaken the field's covariance.
    pub kept: f64,
}

/// Waves of every frequency.
#[derive(Clone, Debug)]
pub(crate) struct Waves {
    /// One for each bin of the spectra, frequencies ascending.
    pub lines: Vec<SpectralLine>,
    bessel: Bessel,
}

impl Waves {
    /// Waves for the bins of `spectra`; `wavenumber` gives k (rad/m) of an angular frequency (rad/s), distances go up
    /// to `reach` (m).
    ///
    /// # Errors
    /// [`CalibrateError::Range`] for a wavenumber that cannot be.
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

    /// Covariance of the field at two places a distance (m) apart, over its power.
    pub fn covariance(&self, line: &SpectralLine, distance: f64) -> f64 {
        let ring = self.bessel.ring(line.k * distance);
        if line.nugget == 0.0 {
            return ring;
        }
        ring + line.nugget * (self.bessel.disc(line.stray_k * distance) - ring)
    }
}
