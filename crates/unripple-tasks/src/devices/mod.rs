//! `devices`: lists the devices through which drives can be played.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::run;
