//! `fit`: the model fitted to what a library's actuators heard of each other.

mod ask;
mod fill;
mod heard;
mod probed;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::run;
