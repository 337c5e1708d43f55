//! `sweep`: gives many designs to one task, in shards that survive any kill, and puts the figures in one table.

mod ask;
mod counted;
mod design;
mod figure;
mod files;
mod flat;
mod folder;
mod pairs;
mod piece;
mod plan;
mod report;
mod row;
mod run;
mod supervised;
mod surface;
mod table;
mod tally;
mod tasks;
mod values;
mod workers;

pub use ask::Ask;
pub use counted::{Extreme, FailedDesign, Named};
pub use design::Design;
pub use pairs::Pairs;
pub use piece::Piece;
pub use plan::Plan;
pub use report::Report;
pub use row::Row;
pub use run::{compute, run, run_with};
pub use workers::Workers;
