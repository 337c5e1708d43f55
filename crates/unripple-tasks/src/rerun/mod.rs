//! `rerun`: repeats the run that made a report, from the record in the report.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::{record, repeat, run};
