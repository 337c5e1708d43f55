//! Options of the task `rerun`.

use crate::TaskError;
use crate::record::{Request, Visit};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which run is to be repeated, and where its results go.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A report.json, or what `--json` printed.
    pub report: PathBuf,
    /// Where results go; without it figures in numbers alone are made, where the command can do so.
    pub output: Option<PathBuf>,
}

impl Request for Ask {
    const COMMAND: &'static str = "rerun";

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        visit(&mut self.report)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
