//! `materials`: lists the materials that surface files may name, with the sources of their values.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::{MaterialRow, Report};
pub use run::run;
