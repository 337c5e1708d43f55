//! `view` as a task: a plain question, progress with a cancel flag, a report.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::run;
