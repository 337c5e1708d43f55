//! Options of the task `reproduce`.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple_tasks::record::Request;

/// Options of `reproduce`: number of random placements of actuators and targets, and folder for the page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// Folder for the page and its figures; without it only the numbers are computed. An existing folder is
    /// replaced as a whole, but only if it holds nothing but the unchanged files of an earlier run.
    pub output: Option<PathBuf>,
    /// Number of random placements of actuators and targets over which statistics of contrast are averaged,
    /// 2 to 10 000.
    pub placements: usize,
}

impl Default for Ask {
    fn default() -> Self {
        Self { output: None, placements: 20 }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "reproduce";

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
