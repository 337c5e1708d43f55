//! `rerun`: a report's run once more, from what the report says of it.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::{record, repeat, run};
