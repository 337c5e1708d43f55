//! `stroke`: computes a drive whose focus moves along a path.

mod ask;
mod report;
mod run;

pub use crate::played::{Made, figures};
pub use ask::Ask;
pub use report::Report;
pub use run::{check, make, make_on, run, run_on};
