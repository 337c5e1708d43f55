//! Options for joining a JACK server.

use super::links::Links;

/// Options for joining a JACK server.
#[derive(Clone, Debug, PartialEq)]
pub struct JackOptions {
    /// Name of this program as a client of the server.
    pub client: String,
    /// Name of the server; the default server if `None`.
    pub server: Option<String>,
    /// Names of the outputs (actuators). The port of `a1` is called `out_a1`.
    pub outputs: Vec<String>,
    /// Names of the inputs (sensors, probe). The port of `a1` is called `in_a1`.
    pub inputs: Vec<String>,
    /// Ports to which the client's ports are connected.
    pub links: Links,
    /// Number of samples per exchanged block, 1 to 65536, independent of the server's period; equal to that
    /// period if `None`.
    pub block: Option<usize>,
    /// Drive, in the actuators' unit, to which a sample of 1 (full scale) corresponds.
    pub full_scale: f64,
    /// Number of blocks of drive that are buffered ahead of the server, and at least two periods of the
    /// server if these are longer than blocks: the program may be late by that time, and all latencies are
    /// longer by it.
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
