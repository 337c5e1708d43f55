//! From recordings to responses: sweeps and deconvolution, kriging between points, model updating, a Kalman filter
//! for drift.

mod between;
mod drift;
mod error;
mod fit;
pub mod measure;
pub mod signals;
pub mod verify;

pub use between::{Between, BetweenOptions, Interpolation, Uncertainty};
pub use drift::*;
pub use error::CalibrateError;
pub use fit::*;
