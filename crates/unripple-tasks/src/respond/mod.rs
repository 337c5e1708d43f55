//! `respond`: responses from the model, as a library.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::{MOST_VALUES, run};
