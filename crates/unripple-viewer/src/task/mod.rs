//! `view` as a task: a struct of options, a function that can be cancelled, a report.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::run;
