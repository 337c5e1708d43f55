//! Measuring responses through a device, with a probe on the surface or by tapping it.

mod campaign;
mod hearing;
mod latency;
mod options;
mod record;
mod rig;
mod session;
mod tap;
mod taps;
mod tones;
mod wires;

pub use campaign::{Progress, Sink, Way, campaign};
pub use hearing::Hearing;
pub use latency::latency;
pub use options::MeasureOptions;
pub use record::{SILENCE, record};
pub use rig::Rig;
pub use session::{Channel, Listen, Session};
pub use tap::{TapOptions, Tapped, tapped};
pub use taps::TapSession;
pub use wires::{REFERENCE, Wires};
