//! Multi-touch screens of Linux.

mod axis;
mod contacts;
#[cfg(target_os = "linux")]
mod linux;
mod reader;
mod slots;

pub use axis::Axis;
pub use contacts::Contacts;
pub use reader::Screen;
pub use slots::{Event, Report, Slots};
