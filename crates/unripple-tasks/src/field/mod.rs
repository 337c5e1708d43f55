//! `field`: evaluates the motion of a surface under any drive.

mod ask;
mod report;
mod run;
mod write;

pub use ask::{Ask, DriveAsk};
pub use report::Report;
pub use run::{Made, make, run};
