//! Options of `unripple rerun`.

use super::examples;
use clap::Args;
use std::path::PathBuf;

/// Options of `rerun`.
#[derive(Debug, Args)]
#[command(after_help = examples::RERUN)]
pub struct RerunOptions {
    /// The report.json of an earlier run, or a file with what --json printed.
    pub report: PathBuf,
    /// Folder for the results, or another output as the repeated command's -o describes it. Without this option only the report
    /// is printed.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}
