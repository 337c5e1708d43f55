//! A JACK server (which PipeWire is, too) as a device, and a virtual surface as a client of one.

mod bridge;
mod crossing;
mod device;
mod events;
mod library;
mod links;
mod options;
mod watch;
mod wires;

pub use bridge::Bridge;
pub use device::Jack;
pub use links::Links;
pub use options::JackOptions;

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

/// Prepares a program for being ended from outside: waits until none of its clients is joining a JACK server or leaving it, ten seconds
/// at most, and lets none do so any more. A program that ends by itself needs no call of this.
///
/// While a client joins or leaves, JACK 2 locks a database that all JACK programs of a user share. The lock of a program that ends
/// meanwhile is never released: every JACK program started later waits for ever.
pub fn shut() {
    library::shut();
}

/// Asks a server for its properties, if one answers.
pub(crate) fn look(server: Option<&str>) -> Result<Seen, crate::DevicesError> {
    let client = Client::open("unripple-devices", server)?;
    Ok(Seen {
        rate: client.rate(),
        block: client.period(),
        playback: client.ports(Side::Playback, false),
        capture: client.ports(Side::Capture, false),
    })
}
