//! `compare`: compares all focusing methods on the same targets.

mod ask;
mod failed;
mod figure;
mod front;
mod ground;
mod report;
mod row;
mod run;
mod trade;

pub use ask::Ask;
pub use failed::Failed;
pub use front::Front;
pub use report::Report;
pub use row::Row;
pub use run::run;
