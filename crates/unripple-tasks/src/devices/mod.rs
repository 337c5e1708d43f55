//! `devices`: what drives can be played through.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::run;
