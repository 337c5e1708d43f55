//! `import`: makes a library of responses that other programs measured, or of modes that they identified.

mod abscissa;
mod ask;
mod assembled;
mod bytes;
mod found;
mod from_arrays;
mod from_modes;
mod from_table;
mod from_uff;
mod from_wav;
mod joining;
mod labels;
mod measured;
mod modal;
mod on_surface;
mod pattern;
mod read;
mod report;
mod run;
mod spectrum;
mod uff_modes;
mod uff_nodes;
mod units;

pub use ask::{Ask, Kind, Per, Quantity};
pub use report::Report;
pub use run::run;
