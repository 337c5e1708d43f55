//! `drift`: whether a sheet's tension is still what its responses were made for, and whether it goes on changing.

mod ask;
mod bench;
mod cost;
mod known;
mod report;
mod run;

pub use ask::Ask;
pub use cost::Cost;
pub use report::{Report, Step, Verdict};
pub use run::run;
