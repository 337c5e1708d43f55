//! `unripple modes`: lists natural frequencies and decay times.

use crate::args::ModesOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::modes::{self, Ask};

/// Lists the modes of a surface.
pub fn run(options: &ModesOptions, common: &Common) -> Result<(), CliError> {
    let ModesOptions { surface, max_hz } = options;
    let ask = Ask { surface: common.surface(surface), top_hz: *max_hz, ..Ask::default() };
    output::perform(common.json, &ask, modes::run)
}
