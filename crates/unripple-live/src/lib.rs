//! Live play of a surface: touch, effects and drift of the tension joined to player, focusing and devices.
//!
//! The parts come from the crates below: sources of touches, effects, methods of focusing, player, devices. Here they are
//! connected, with the threads that they need. The caller chooses and opens them.
//!
//! # In reading order
//!
//! A [`Window`] is the time from the beginning of a drive to its focus. A [`FocusWorker`] computes drives on a thread
//! of its own, a [`DriveCache`] keeps them by place, a [`Conductor`] turns touches into commands for the player, and
//! a [`Heartbeat`] runs the player and the device. An [`Engine`] joins all of these; a
//! [`Feeler`](unripple_devices::Feeler) computes what fingers feel of a virtual surface, a [`Follower`] follows its
//! tension, and a [`Recovering`] device is reopened when it is lost.
//!
//! ```
//! use std::sync::Arc;
//! use unripple_devices::{Virtual, VirtualOptions};
//! use unripple_effects::{Button, Effect, EffectSet, Kind, Level, Region};
//! use unripple_live::{Engine, FocusWorker, LiveOptions};
//! use unripple_physics::{ResponseOptions, design::papers_surface, responses};
//! use unripple_touch::{Playback, Recording, Sources};
//!
//! let mut film = papers_surface();
//! film.emission.band = [0.0, 1500.0];
//! let options = LiveOptions::new(&film, 0.010);
//! let worker = FocusWorker::new(Arc::new(responses(&film, &ResponseOptions::default())?), &options.focus)?;
//! // A pulse wherever a finger comes down, at half the limit.
//! let kind = Kind::Button(Button { press_force: None, release: 0.0 });
//! let click = Effect { name: "click".into(), region: Region::Everywhere, level: Level::Share(0.5), kind };
//! let set = EffectSet { name: "clicks".into(), about: String::new(), effects: vec![click] };
//! // A finger that comes down after 10 ms.
//! let tap = r#"{"format":"unripple-touches","version":1}
//! {"at_ms":10,"finger":1,"phase":"down","at_mm":[62,90]}
//! {"at_ms":200,"finger":1,"phase":"up","at_mm":[62,90]}"#;
//! let mut sources = Sources::new(&film.outline);
//! sources.push(Box::new(Playback::new(Recording::read(tap)?, &film.outline)?));
//!
//! let device = Virtual::new(&film, &VirtualOptions::default())?;
//! let mut engine = Engine::new(&film, worker, &set, sources, Box::new(device), &options)?;
//! let mut largest = 0.0_f32;
//! while engine.stage().time() < 0.050 {
//!     engine.step()?;
//!     largest = engine.heart().drive().iter().fold(largest, |most, d| most.max(d.abs()));
//! }
//! assert!((largest - 0.5).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod beats;
mod conductor;
mod drive_cache;
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
mod stage;
mod threaded;
mod timeline;
mod touch_input;
mod voice_state;
mod voices;
mod waiting;
mod window;

pub use conductor::Conductor;
pub use drive_cache::{CachedDrive, DriveCache, Full};
pub use engine::Engine;
pub use error::LiveError;
pub use focus_worker::{FocusDrive, FocusWorker};
pub use follower::Follower;
pub use heartbeat::Heartbeat;
pub use level::Level;
pub use log::Began;
pub use options::{LONGEST_WINDOW, LiveOptions, Timing};
pub use percentiles::Percentiles;
pub use play_stats::PlayStats;
pub use priority::{Priorities, real_time};
pub use recovering::{Opener, Recovering};
pub use stage::{Listener, Stage};
pub use threaded::PlayState;
pub(crate) use timeline::Timeline;
pub use window::Window;
