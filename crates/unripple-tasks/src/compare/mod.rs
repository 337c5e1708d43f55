//! `compare`: compares focusing methods on the same targets, on one surface or several.

mod ask;
mod compared;
mod failed;
mod figure;
mod front;
mod ground;
mod report;
mod row;
mod run;
mod table;
mod trade;

pub use ask::Ask;
pub use compared::Compared;
pub use failed::{Failed, FailedSurface};
pub use front::Front;
pub use report::{On, Report};
pub use row::Row;
pub use run::run;
