//! `check`: lists all faults of a surface file.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::{Costs, Report};
pub use run::run;
