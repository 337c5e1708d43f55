//! Options of the task `devices`.

use crate::record::Request;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which JACK server to list, besides the other devices.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// Name of the JACK server whose ports are listed; by default JACK's default server.
    pub server: Option<String>,
}

impl Request for Ask {
    const COMMAND: &'static str = "devices";

    fn send_to(&mut self, _output: Option<PathBuf>) {}
}
