//! `drift`: measures how much a sheet's tension differs from the one that its responses assume, and whether
//! it keeps changing.

mod ask;
mod cost;
mod known;
mod ping_device;
mod report;
mod run;

pub use ask::Ask;
pub use cost::Cost;
pub use report::{Report, Step, Verdict};
pub use run::run;
