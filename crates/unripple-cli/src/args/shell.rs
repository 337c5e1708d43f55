//! Options of `cache`, `completions` and `man`.

use super::examples;
use clap::Args;
use clap_complete::Shell;
use std::path::PathBuf;

/// Options of `cache`.
#[derive(Debug, Args)]
#[command(after_help = examples::CACHE)]
pub struct CacheOptions {
    /// Remove all results from the cache.
    #[arg(long)]
    pub empty: bool,
}

/// Options of `completions`.
#[derive(Debug, Args)]
#[command(after_help = examples::COMPLETIONS)]
pub struct CompletionsOptions {
    /// The shell that the completions are for.
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Options of `man`.
#[derive(Debug, Args)]
#[command(after_help = examples::MAN)]
pub struct ManOptions {
    /// Folder for the pages, one for each command. An existing folder is replaced only if it holds nothing but the unchanged
    /// files of an earlier run.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
}
