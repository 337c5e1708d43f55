//! `unripple cache`: the cache of computed modes on this machine.

use crate::args::CacheOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;

/// Prints the size of the cache, or empties it.
pub fn run(options: &CacheOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    output::report(common.json, &unripple_tasks::cache::look(options.empty)?)
}
