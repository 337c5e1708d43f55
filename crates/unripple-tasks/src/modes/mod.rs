//! `modes`: computes natural frequencies and decay times of a surface's modes.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::{Loaded, Report};
pub use run::run;
