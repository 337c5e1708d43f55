//! `field`: evaluates the motion of a surface under any drive.

mod ask;
mod made;
mod report;
mod run;
mod write;

pub use ask::{Ask, DriveAsk};
pub use made::Made;
pub use report::Report;
pub(crate) use run::drive;
pub use run::{check, make, make_on, run, run_on};
pub use write::{animation, figures};
