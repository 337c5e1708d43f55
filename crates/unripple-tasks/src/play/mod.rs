//! `play`: drives a surface live, in response to touches.

mod ask;
mod open;
mod outputs;
mod report;
mod run;
mod stepped;
mod touches;

pub use ask::{Ask, TouchAsk};
pub use open::{Opener, latency, opener};
pub use report::Report;
pub use run::{follower, run};
pub use stepped::Stepped;
