//! `respond`: computes responses from the model, and stores them in a library.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::{MOST_VALUES, run};
