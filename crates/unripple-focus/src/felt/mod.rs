//! Drives that are felt at the targets and hardly elsewhere: regularised (Tikhonov) least squares in felt
//! displacement.

mod background;
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
