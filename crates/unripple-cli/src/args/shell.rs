//! Options of `completions` and `man`.

use clap::Args;
use clap_complete::Shell;
use std::path::PathBuf;

/// Options of `completions`.
#[derive(Debug, Args)]
pub struct CompletionsOptions {
    /// The shell that they are for.
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Options of `man`.
#[derive(Debug, Args)]
pub struct ManOptions {
    /// Folder for the pages, one for each command. An earlier run's folder is replaced whole, unless something else is in it.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
}
