//! Tracking of a sheet's tension while the surface is in use.

mod hold;
mod ping;
mod run;
mod tracker;
mod warp;

pub use hold::{Held, Hold};
pub use ping::{Ping, PingOptions};
pub use tracker::Tracker;
pub use warp::Warp;

use crate::CalibrateError;
use unripple_core::require;

/// Options of the Kalman filter that tracks tension: noise of the sensors; range, rate and random walk of
/// the tension.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracking {
    /// Root mean square of the noise on each sensor, in its unit.
    pub noise: f64,
    /// Rms error of the model, as a share of the rms of the sensors' signals.
    pub model: f64,
    /// Largest deviation from nominal tension that is searched, as a share of it; also the standard
    /// deviation of the tension before the first observation.
    pub range: f64,
    /// Standard deviation of the rate of change of tension before the first observation, as a share of the tension
    /// per second.
    pub speed: f64,
    /// Random walk of the rate of change of tension: the standard deviation that it gains in one second, as a share
    /// of the tension per second.
    pub wander: f64,
    /// Largest ratio of the rms residual to noise and model error with which the model counts as explaining the
    /// signals.
    pub limit: f64,
}

impl Default for Tracking {
    fn default() -> Self {
        Self { noise: 1e-6, model: 0.0, range: 0.08, speed: 0.01, wander: 1e-3, limit: 3.0 }
    }
}

impl Tracking {
    fn check(&self) -> Result<(), CalibrateError> {
        let positive = [
            ("noise of the sensors", self.noise),
            ("range of the tension", self.range),
            ("speed of the tension", self.speed),
            ("wander of the tension", self.wander),
            ("limit of the residual", self.limit),
        ];
        for (what, value) in positive {
            require(what, value > 0.0 && value.is_finite(), "a positive number", value)?;
        }
        Ok(require("error of the model", (0.0..1.0).contains(&self.model), "between 0 and 1", self.model)?)
    }
}

/// Result of one observation of the tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drift {
    /// The model with some tension explains the sensors' signals.
    Followed {
        /// Ratio of the tension to that at calibration, at the end of the observation.
        tension: f64,
        /// Standard error of `tension`.
        error: f64,
        /// Rate of change of `tension`, in 1/s.
        rate: f64,
        /// Standard error of `rate`, in 1/s.
        rate_error: f64,
        /// Rms residual, relative to noise and model error.
        excess: f64,
    },
    /// No tension explains the sensors' signals: the surface should be calibrated again.
    Unexplained {
        /// Ratio of the tension to that at calibration, predicted from earlier observations.
        tension: f64,
        /// Smallest rms residual found, relative to noise and model error.
        excess: f64,
        /// Largest `excess` with which the model counts as explaining the signals.
        limit: f64,
    },
}

impl Drift {
    /// Ratio of the tension to that at calibration.
    pub fn tension(&self) -> f64 {
        match self {
            Self::Followed { tension, .. } | Self::Unexplained { tension, .. } => *tension,
        }
    }

    /// Whether the surface should be calibrated again.
    pub fn needs_calibration(&self) -> bool {
        matches!(self, Self::Unexplained { .. })
    }
}
