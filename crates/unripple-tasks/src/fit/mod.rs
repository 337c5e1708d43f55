//! `fit`: fits the model to the responses between a library's actuators.

mod ask;
mod fill;
mod measurements;
mod probed;
mod report;
mod run;

pub use ask::Ask;
pub(crate) use fill::FITTED_TO;
pub(crate) use measurements::{Measurements, TOP};
pub use report::Report;
pub use run::run;
pub(crate) use run::{MOST, model, reach};
