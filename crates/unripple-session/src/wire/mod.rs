//! The protocol between pages and server: JSON commands one way, JSON messages and binary frames the other.

mod command;
mod frame;

pub use command::LONGEST;
pub use command::{Command, Edit, Job, Measure, Phase, Probe, Refused, Settings, Transport};
pub use frame::{Frame, Head, Resting, Strip};
