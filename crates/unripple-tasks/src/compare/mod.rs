//! `compare`: compares all focusing methods on the same targets.

mod ask;
mod figure;
mod front;
mod report;
mod row;
mod run;

pub use ask::Ask;
pub use front::Front;
pub use report::{Failed, Report};
pub use row::Row;
pub use run::run;
