//! Options of drives for waveforms: quantity, band, regularisation and limits.

use super::Quantity;
use crate::FocusError;
use unripple_core::require;

/// Options of [`play`](super::play): quantity, band, regularisation and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayOptions {
    /// Quantity of the samples: displacement or velocity.
    pub quantity: Quantity,
    /// Lowest and highest frequency that is played, in Hz; the responses' band where `None`. The prescribed
    /// motion fades out over the highest tenth of the band.
    pub band: Option<[f64; 2]>,
    /// Weight λ of the drive's energy against the error, dimensionless; see [`play`](super::play). A single target
    /// whose response has the mean strength g is followed at 1/(1 + λ) of its amplitude: half at 1, practically all at
    /// 1e-5.
    pub energy_weight: f64,
    /// How long before the first waveform the drive may begin, and how long after the end of the last
    /// waveform it may end, in seconds.
    pub lead: [f64; 2],
    /// Largest drive per actuator, in the drive's unit. A drive above it is scaled down as a whole.
    pub limit: f64,
    /// Largest rms per actuator over the whole drive, in the drive's unit. A drive above it is scaled down as a whole.
    pub rms_limit: Option<f64>,
    /// The iteration ends when the residual of the dual equations is at most this share of their right-hand side
    /// (Euclidean norms); see [`play`](super::play).
    pub tolerance: f64,
    /// Largest number of iterations of the conjugate gradients.
    pub passes: usize,
}

impl Default for PlayOptions {
    /// Displacement over the whole band, 30 ms before and after, at a limit of 1.
    fn default() -> Self {
        Self {
            quantity: Quantity::Displacement,
            band: None,
            energy_weight: 1e-5,
            lead: [30e-3; 2],
            limit: 1.0,
            rms_limit: None,
            tolerance: 1e-3,
            passes: 100,
        }
    }
}

impl PlayOptions {
    /// Checks that all numbers are in their ranges.
    pub(super) fn check(&self) -> Result<(), FocusError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        for (what, x) in [("limit", self.limit), ("rms limit", self.rms_limit.unwrap_or(1.0))] {
            require(what, positive(x), "a positive number", x)?;
        }
        for (what, x) in [("energy weight", self.energy_weight), ("tolerance", self.tolerance)] {
            require(what, (1e-12..=1e12).contains(&x), "1e-12 to 1e12", x)?;
        }
        self.lead.iter().try_for_each(|lead| {
            Ok(require("lead of a waveform (s)", lead.is_finite() && *lead >= 0.0, "0 or more", *lead)?)
        })
    }
}
