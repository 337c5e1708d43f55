//! `fit`: fits the model to the responses between a library's actuators.

mod ask;
mod fill;
mod heard;
mod probed;
mod report;
mod run;

pub use ask::Ask;
pub(crate) use fill::FITTED_TO;
pub(crate) use heard::Measurements;
pub use report::Report;
pub(crate) use run::model;
pub use run::run;
