//! Options of `unripple sweep`.

use super::{examples, heading};
use clap::Args;
use std::path::PathBuf;

/// Options of `sweep`.
#[derive(Debug, Args)]
#[command(after_help = examples::SWEEP)]
pub struct SweepOptions {
    /// The plan: a TOML file that names a task, a surface, and the keys and options that vary.
    pub plan: PathBuf,
    /// Compute this shard alone, counted from 0: for job arrays, GNU parallel, Snakemake and the like. Whoever completes the last shard writes
    /// the table.
    #[arg(long, value_name = "K", conflicts_with_all = ["count", "jobs"])]
    pub shard: Option<usize>,
    /// Number of processes that compute at a time, each its own shards.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub jobs: usize,
    /// Print the number of designs and shards, and what the modes of the first design cost, and compute nothing.
    #[arg(long)]
    pub count: bool,
    /// Write no pictures.
    #[arg(long, help_heading = heading::RESULTS)]
    pub no_figures: bool,
    /// Width of the picture, in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default it depends on the plan.
    #[arg(long, value_name = "1|2", help_heading = heading::RESULTS)]
    pub columns: Option<usize>,
    /// Folder for rows, table, report and picture. Designs of the same plan that are already in it are not
    /// computed again.
    #[arg(short, long, value_name = "DIR", required_unless_present = "count", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
    /// Compute the part of a sweep assigned by the process that started this one, and end when standard input
    /// ends.
    #[arg(long, hide = true, conflicts_with_all = ["count", "shard"])]
    pub piece: Option<String>,
}
