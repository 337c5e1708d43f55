//! Options of `unripple rerun`.

use super::examples;
use clap::Args;
use std::path::PathBuf;

/// Options of `rerun`.
#[derive(Debug, Args)]
#[command(after_help = examples::RERUN)]
pub struct RerunOptions {
    /// A report.json of an earlier run, or what --json printed.
    pub report: PathBuf,
    /// Where results go: a folder, or what the command calls its output. Without it only the report is printed.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}
