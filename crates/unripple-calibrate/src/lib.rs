//! Recordings to responses: measuring, interpolating, fitting a model, following drift.

mod between;
mod error;
pub mod measure;

pub use between::{Between, BetweenOptions, Interpolation, Uncertainty};
pub use error::CalibrateError;
