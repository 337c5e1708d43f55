//! Drives that are felt at the targets and hardly elsewhere.

mod background;
mod ceiling;
mod control;
mod lines;
mod options;
mod plan;
mod reduced;
mod solve;
mod splines;
mod watch;

pub use options::FeltOptions;
pub use plan::FeltPlan;
