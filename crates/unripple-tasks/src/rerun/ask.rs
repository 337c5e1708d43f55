//! Options of the task `rerun`.

use crate::TaskError;
use crate::record::{Request, Visit};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which run to repeat, and where to write its results.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// File of the report whose run is repeated: a report.json, or the output of `--json`.
    pub report: PathBuf,
    /// Where results are written; by default no file is written and only the report is returned, if the
    /// command allows that.
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
