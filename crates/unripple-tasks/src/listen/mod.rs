//! `listen`: finds natural frequencies and decay times in the recording of a knock.

mod ask;
mod figure;
mod report;
mod run;

pub use ask::Ask;
pub use report::{Report, Rung, Tone};
pub use run::run;
