//! Measuring responses through a device, with a probe on the surface or by tapping it.

mod account;
mod apart;
mod campaign;
mod channel;
mod force;
mod heard;
mod hearing;
mod knock;
mod latency;
mod law;
mod mend;
mod options;
mod record;
mod rig;
mod session;
mod take;
mod tap;
mod taps;
mod telling;
mod timing;
mod tones;
mod wires;

pub use account::{Account, Knocked, Lost};
pub use campaign::{Progress, Sink, Way, campaign};
pub use channel::{BandQuality, Channel};
pub use force::TapOptions;
pub use hearing::Hearing;
pub use latency::latency;
pub use options::{MOST_KEPT, MOST_REPEATS, MeasureOptions, slowest_decay};
pub use record::{SILENCE, record};
pub use rig::Rig;
pub use session::{Listen, Session};
pub use tap::{Tapped, tapped};
pub use taps::TapSession;
pub use wires::{REFERENCE, Wires};
