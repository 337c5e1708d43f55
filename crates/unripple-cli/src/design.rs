//! `unripple design`: every tradeoff of a surface before anything is built.

use crate::args::DesignOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::design::{self, Ask};

/// Prints the design figures of a surface.
pub fn run(options: &DesignOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask { surface: common.surface(&options.surface) };
    output::perform(common.json, &ask, design::run)
}
