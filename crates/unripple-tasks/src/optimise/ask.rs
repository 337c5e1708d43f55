//! Options of the task `optimise`.

use super::samples::reads;
use crate::TaskError;
use crate::record::{Request, Visit};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which plan to search by, and where its designs go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// File of the plan, in TOML.
    pub plan: PathBuf,
    /// Folder for designs, table, report and figures; what is there of the same plan is neither asked for nor computed again. Always
    /// needed.
    pub output: Option<PathBuf>,
    /// Compute the designs that have been asked for, and ask for no others.
    pub no_ask: bool,
    /// Number of generations without an improvement after which no more are asked for: of the best design, or with several objectives of
    /// the hypervolume of the front. By default all generations of the plan are computed.
    pub stop_after: Option<usize>,
    /// The least improvement that counts for that, as a share of what was found before, 0 to 1.
    pub stop_share: f64,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of the figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure has its own width.
    pub columns: Option<usize>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            plan: PathBuf::new(),
            output: None,
            no_ask: false,
            stop_after: None,
            stop_share: 0.001,
            no_figures: false,
            columns: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "optimise";

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        if self.plan.as_os_str().is_empty() {
            return Ok(());
        }
        visit(&mut self.plan)?;
        // They are named in the plan, which stays as it is.
        reads(&self.plan).iter_mut().try_for_each(visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
