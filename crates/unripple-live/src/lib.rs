//! Touch, effects and drift joined to player, focus and devices: a surface that is played live.
//!
//! # In reading order
//!
//! A [`Window`] is the delay that a focus costs. A [`Maker`] makes drives on a thread of its own, [`Drives`] remembers them by
//! place, a [`Conductor`] turns touches into commands for the player, and a [`Heartbeat`] plays through a device, or is played by it. An
//! [`Engine`] is all of these at work; a [`Feeler`] tells what fingers feel of a virtual surface, a [`Follower`] follows its tension,
//! and a [`Recovering`] device comes back by itself.

mod beats;
mod conductor;
mod drives;
mod ears;
mod engine;
mod error;
mod follower;
mod heartbeat;
mod level;
mod log;
mod maker;
mod options;
mod pace;
mod percentiles;
mod pinging;
mod priority;
mod pulses;
mod recovering;
#[cfg(test)]
mod slow;
mod sounding;
mod stage;
mod tally;
mod threaded;
mod timeline;
mod voices;
mod waiting;
mod window;

pub use conductor::Conductor;
pub use drives::{At, Drives, Full};
pub use engine::Engine;
pub use error::LiveError;
pub use follower::Follower;
pub use heartbeat::Heartbeat;
pub use level::Level;
pub use log::Began;
pub use maker::{Made, Maker};
pub use options::{LiveOptions, Timing};
pub use percentiles::Percentiles;
pub use priority::{Priorities, real_time};
pub use recovering::{Opener, Recovering};
pub use stage::{Listener, Stage};
pub use tally::Tally;
pub use threaded::Pulse;
pub(crate) use timeline::Timeline;
pub use window::Window;
