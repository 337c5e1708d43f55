//! `doctor`: checks each stage between a touch and what is felt, in turn.

mod ask;
mod check;
mod device;
mod felt;
mod report;
mod run;
mod touch;

pub use ask::Ask;
pub use check::{Check, Verdict};
pub use report::Report;
pub use run::run;
