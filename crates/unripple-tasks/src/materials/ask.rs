//! Options of the task `materials`.

use crate::record::Request;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which materials to list.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// Name of one material; by default all are listed.
    pub name: Option<String>,
}

impl Request for Ask {
    const COMMAND: &'static str = "materials";

    fn send_to(&mut self, _output: Option<PathBuf>) {}
}
