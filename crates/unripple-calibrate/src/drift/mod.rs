//! Tension followed while the surface is in use.

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

/// Options of the drift filter: noise, range, speed and wander of the tension.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracking {
    /// Root mean square of the noise on each sensor, in its unit.
    pub noise: f64,
    /// Error of the model itself, as a share of what is heard.
    pub model: f64,
    /// Largest departure from nominal tension that is looked for, as a share.
    pub range: f64,
    /// Fastest change of tension at first, as a share per second.
    pub speed: f64,
    /// How much the rate of change wanders: its standard deviation after one second, as a share per second.
    pub wander: f64,
    /// Residual over noise and model error above which the model no longer explains what is heard.
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
    /// The model under some tension explains what was heard.
    Followed {
        /// Tension over nominal at the end of the observation.
        tension: f64,
        /// Its standard error.
        error: f64,
        /// Its rate of change, 1/s.
        rate: f64,
        /// The rate's standard error, 1/s.
        rate_error: f64,
        /// Residual over noise and model error.
        excess: f64,
    },
    /// No tension explains what was heard: time to calibrate again.
    Unexplained {
        /// Tension over nominal as predicted.
        tension: f64,
        /// Residual over noise and model error at best.
        excess: f64,
        /// What it may be.
        limit: f64,
    },
}

impl Drift {
    /// Tension over that at calibration, a ratio.
    pub fn tension(&self) -> f64 {
        match self {
            Self::Followed { tension, .. } | Self::Unexplained { tension, .. } => *tension,
        }
    }

    /// Whether the surface should be calibrated again.
    pub fn asks_for_calibration(&self) -> bool {
        matches!(self, Self::Unexplained { .. })
    }
}
