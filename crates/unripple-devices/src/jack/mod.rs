//! A JACK server (which PipeWire is, too) as a device, and a virtual surface as a client of one.

mod bridge;
mod crossing;
mod device;
mod events;
mod library;
mod links;
mod watch;

pub use bridge::Bridge;
pub use device::{Jack, JackOptions};
pub use links::Links;

use events::Side;
use library::Client;

/// Properties of a JACK server: rate, samples per cycle, and the names of all ports that sound can be sent to and
/// comes from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seen {
    pub(crate) rate: f64,
    pub(crate) block: usize,
    pub(crate) playback: Vec<String>,
    pub(crate) capture: Vec<String>,
}

/// For a program that is about to be ended from outside: waits until none of its clients is just joining a JACK server or leaving it, ten
/// seconds at most, and lets none do so any more. A program that ends by itself does so without this call.
///
/// JACK 2 locks a database meanwhile that all JACK programs of a user share, and nobody takes the lock of one that ended within it: every
/// JACK program started then waits for ever.
pub fn shut() {
    library::shut();
}

/// Looks at a server, if one answers.
pub(crate) fn look(server: Option<&str>) -> Result<Seen, crate::DevicesError> {
    let client = Client::open("unripple-devices", server)?;
    Ok(Seen {
        rate: client.rate(),
        block: client.period(),
        playback: client.ports(Side::Playback, false),
        capture: client.ports(Side::Capture, false),
    })
}
