//! `export`: a library in formats that others read.

mod ask;
mod report;
mod run;

pub use ask::{Ask, Format};
pub use report::Report;
pub use run::run;
