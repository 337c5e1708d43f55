//! Ports to which a client's ports are connected.

/// The ports to which a JACK client's ports are connected.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Links {
    /// The system's (physical) playback and capture ports, in order.
    #[default]
    System,
    /// The ports of another client, by its name: `out_a1` of this client is connected to `in_a1` of the
    /// other, and `out_a1` of the other to `in_a1` of this client. [`Bridge`](super::Bridge) has such ports.
    Client(String),
    /// Ports by their full names: one playback port for each output, and one capture port for each input.
    Ports {
        /// Ports that receive, in the order of the outputs.
        playback: Vec<String>,
        /// Ports that send, in the order of the inputs.
        capture: Vec<String>,
    },
    /// No ports: another program connects them.
    None,
}
