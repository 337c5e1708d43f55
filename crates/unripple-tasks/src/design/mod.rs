//! `design`: computes every tradeoff of a surface before anything is built.

mod ask;
mod report;
mod run;

pub use ask::Ask;
pub use report::Report;
pub use run::run;
