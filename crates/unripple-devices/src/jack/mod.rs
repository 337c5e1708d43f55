//! A JACK server (PipeWire acts as one, too) as a device, and a virtual surface as a client of such a
//! server.

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

/// Properties of a JACK server: sample rate, samples per cycle, and the names of all its playback and
/// capture ports.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seen {
    pub(crate) rate: f64,
    pub(crate) block: usize,
    pub(crate) playback: Vec<String>,
    pub(crate) capture: Vec<String>,
}

/// Prepares a program for termination from outside: waits, ten seconds at most, until none of its clients is
/// joining or leaving a JACK server, and prevents all later joining and leaving. A program that ends by
/// itself need not call this.
///
/// While a client joins or leaves, JACK 2 locks a database that all JACK programs of a user share. The lock of a program that ends
/// meanwhile is never released: every JACK program started later waits for ever.
pub fn shut() {
    library::shut();
}

/// Reads the properties of a server, if one answers.
pub(crate) fn look(server: Option<&str>) -> Result<Seen, crate::DevicesError> {
    let client = Client::open("unripple-devices", server)?;
    Ok(Seen {
        rate: client.rate(),
        block: client.period(),
        playback: client.ports(Side::Playback, false),
        capture: client.ports(Side::Capture, false),
    })
}
