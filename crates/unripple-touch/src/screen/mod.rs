//! Multi-touch screens of Linux.

#[cfg(target_os = "linux")]
mod linux;
mod reader;
mod slots;

pub use reader::{Axis, Contacts, Screen};
pub use slots::{Event, Report, Slots};
