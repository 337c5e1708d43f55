//! `export`: writes a library of responses in formats that other programs read.

mod ask;
mod foreign;
mod report;
mod run;

pub use ask::{Ask, Format};
pub use report::Report;
pub use run::run;
