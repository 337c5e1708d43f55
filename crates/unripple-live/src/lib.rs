//! Live play of a surface: touch, effects and drift of the tension joined to player, focusing and devices.
//!
//! # In reading order
//!
//! A [`Window`] is the time from the beginning of a drive to its focus. A [`FocusWorker`] computes drives on a thread
//! of its own, a [`DriveCache`] keeps them by place, a [`Conductor`] turns touches into commands for the player, and
//! a [`Heartbeat`] runs the player and the device. An [`Engine`] joins all of these; a
//! [`Feeler`](unripple_devices::Feeler) computes what fingers feel of a virtual surface, a [`Follower`] follows its
//! tension, and a [`Recovering`] device is reopened when it is lost.

mod beats;
mod conductor;
mod drive_cache;
mod ears;
mod engine;
mod error;
mod focus_worker;
mod follower;
mod heartbeat;
mod level;
mod log;
mod options;
mod pace;
mod percentiles;
mod pinging;
mod play_stats;
mod priority;
mod pulses;
mod recovering;
#[cfg(test)]
mod slow;
mod sounding;
mod stage;
mod threaded;
mod timeline;
mod voices;
mod waiting;
mod window;

pub use conductor::Conductor;
pub use drive_cache::{At, DriveCache, Full};
pub use engine::Engine;
pub use error::LiveError;
pub use focus_worker::{FocusDrive, FocusWorker};
pub use follower::Follower;
pub use heartbeat::Heartbeat;
pub use level::Level;
pub use log::Began;
pub use options::{LiveOptions, Timing};
pub use percentiles::Percentiles;
pub use play_stats::PlayStats;
pub use priority::{Priorities, real_time};
pub use recovering::{Opener, Recovering};
pub use stage::{Listener, Stage};
pub use threaded::Pulse;
pub(crate) use timeline::Timeline;
pub use window::Window;
