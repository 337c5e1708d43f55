//! Options of `unripple optimise`.

use super::{FigureOptions, examples, heading};
use crate::common::Common;
use crate::error::CliError;
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::optimise::Ask;

/// Options of `optimise`.
#[derive(Debug, Args)]
#[command(after_help = examples::OPTIMISE)]
pub struct OptimiseOptions {
    /// The plan: a TOML file that names a task, a surface, the unknowns, and the figures that are to be most or least.
    pub plan: PathBuf,
    /// Number of processes that compute at a time, each its own designs.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub jobs: usize,
    /// Compute the designs that have been asked for, and ask for no others: that takes the Python package, this does not.
    #[arg(long)]
    pub no_ask: bool,
    /// Ask for no more designs once this many generations have brought no improvement: of the best design, or with several objectives of the
    /// hypervolume of the front. By default all generations of the plan are computed.
    #[arg(long, value_name = "GENERATIONS")]
    pub stop_after: Option<usize>,
    /// The least improvement that counts for --stop-after, in per cent of what was found before.
    #[arg(
        long,
        value_name = "PERCENT",
        default_value_t = 0.1,
        allow_negative_numbers = true,
        requires = "stop_after"
    )]
    pub stop_percent: f64,
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Folder for designs, table, report and picture. What is there of the same plan is neither asked for nor computed again.
    #[arg(short, long, value_name = "DIR", help_heading = heading::RESULTS)]
    pub output: PathBuf,
}

impl OptimiseOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        common.without_surface()?;
        Ok(Ask {
            plan: self.plan.clone(),
            output: Some(self.output.clone()),
            no_ask: self.no_ask,
            stop_after: self.stop_after,
            stop_share: self.stop_percent / 100.0,
            no_figures: self.figures.no_figures,
            columns: self.figures.columns,
        })
    }
}
