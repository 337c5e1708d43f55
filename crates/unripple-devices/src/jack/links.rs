//! Ports that a client's ports are connected to.

/// The ports that a JACK client's ports are connected to.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Links {
    /// The system's playback and capture ports, in order.
    #[default]
    System,
    /// Another client, by its name: the port `out_a1` of this client to its `in_a1`, its `out_a1` to the port `in_a1` of
    /// this one. [`Bridge`](super::Bridge) has such ports.
    Client(String),
    /// Ports by their full names: one to play to for each output, one to record from for each input.
    Ports {
        /// Ports that receive, in the order of the outputs.
        playback: Vec<String>,
        /// Ports that send, in the order of the inputs.
        capture: Vec<String>,
    },
    /// No ports: another program connects them.
    None,
}
