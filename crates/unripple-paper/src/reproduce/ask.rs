//! Options of the task `reproduce`.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How thoroughly the paper is done again, and where the page is to be.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// Folder for the page and its figures; without it the numbers alone are made. An earlier run's folder is replaced whole, unless
    /// something else is in it.
    pub output: Option<PathBuf>,
    /// Placements averaged in the statistics of contrast, 2 or more.
    pub placements: usize,
}

impl Default for Ask {
    fn default() -> Self {
        Self { output: None, placements: 20 }
    }
}
