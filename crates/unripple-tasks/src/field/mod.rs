//! `field`: what any drive does to a surface.

mod ask;
mod report;
mod run;
mod write;

pub use ask::{Ask, DriveAsk};
pub use report::Report;
pub use run::{Made, make, run};
