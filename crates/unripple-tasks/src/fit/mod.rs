//! `fit`: the model fitted to the responses of a library's actuators at each other.

mod ask;
mod fill;
mod heard;
mod probed;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::run;
