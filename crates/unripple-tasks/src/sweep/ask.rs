//! Options of the task `sweep`.

use super::files;
use crate::TaskError;
use crate::record::{Request, Visit};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Request to compute a plan, all of it or one shard, with the folder for its results.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// File of the plan, in TOML.
    pub plan: PathBuf,
    /// Folder for rows, table, report and figures; what is there of the same plan is not computed again. Needed unless `count` is set.
    pub output: Option<PathBuf>,
    /// The only shard to compute, counted from 0; by default all that are missing.
    pub shard: Option<usize>,
    /// Count designs and shards, estimate what the first design costs, and compute nothing.
    pub count: bool,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of the figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure has its own width.
    pub columns: Option<usize>,
}

impl Request for Ask {
    const COMMAND: &'static str = "sweep";

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        if self.plan.as_os_str().is_empty() {
            return Ok(());
        }
        visit(&mut self.plan)?;
        // They are named in the plan, which stays as it is.
        files::reads(&self.plan).iter_mut().try_for_each(visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
