//! What pages and server say to each other.

mod command;
mod frame;

pub(crate) use command::LONGEST;
pub use command::{Command, Edit, Job, Measure, Phase, Probe, Refused, Settings, Transport};
pub use frame::{Frame, Head, Resting, Strip};
