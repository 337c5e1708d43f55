//! Options of the task `devices`.

use serde::{Deserialize, Serialize};

/// The JACK server to look at.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// Name of the JACK server to look at; by default the default one.
    pub server: Option<String>,
}
