//! `fit --modes`: fits a surface to natural frequencies alone.

mod ask;
mod figure;
mod found;
mod report;
mod run;
mod text;

pub use ask::{Ask, ModeAsk};
pub use found::{Losses, Mode, Other, Telling, Untold, Value};
pub use report::Report;
pub use run::run;
