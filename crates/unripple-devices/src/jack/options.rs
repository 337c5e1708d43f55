//! Options for joining a JACK server.

use super::links::Links;

/// Options for joining a JACK server.
#[derive(Clone, Debug, PartialEq)]
pub struct JackOptions {
    /// Name of the client.
    pub client: String,
    /// Name of the server; the default one where `None`.
    pub server: Option<String>,
    /// Names of the outputs: actuators. The port of `a1` is `out_a1`.
    pub outputs: Vec<String>,
    /// Names of the inputs: sensors, probe. The port of `a1` is `in_a1`.
    pub inputs: Vec<String>,
    /// What the client's ports are connected to.
    pub links: Links,
    /// Samples per block that is exchanged, 1 to 65536, whatever the server's period; that period where `None`.
    pub block: Option<usize>,
    /// Drive that a sample of 1 stands for, in the actuators' unit.
    pub full_scale: f64,
    /// Number of blocks by which the drive is ahead of the server: the program may be late by them, and all latencies are longer by
    /// them. As many as last two periods, if these are longer than blocks and that is more.
    pub lead: usize,
    /// Time without a cycle after which the server counts as stalled, in s.
    pub patience: f64,
    /// Whether the server freewheels while the device is open: it runs without a clock, as fast as all clients can follow, and
    /// nothing is lost however slow the machine. JACK 2 takes no new clients meanwhile: start those first.
    pub freewheel: bool,
}

impl Default for JackOptions {
    fn default() -> Self {
        Self {
            client: "unripple".into(),
            server: None,
            outputs: Vec::new(),
            inputs: Vec::new(),
            links: Links::System,
            block: None,
            full_scale: 1.0,
            lead: 4,
            patience: 3.0,
            freewheel: false,
        }
    }
}
