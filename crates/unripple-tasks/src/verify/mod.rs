//! `verify`: plays a drive through a device, records a probe at the target and elsewhere, and compares with the prediction.

mod analysis;
mod ask;
mod bench;
mod beside;
mod parting;
mod places;
mod report;
mod run;
mod setting;
mod text;

pub use ask::Ask;
pub use report::{CauseFound, FocusFigures, PlaceFigures, Report, State};
pub use run::{run, run_with};
