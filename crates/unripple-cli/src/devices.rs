//! `unripple devices`: lists the devices through which drives can be played.

use crate::args::DevicesOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::devices::{self, Ask};

/// Lists the devices through which drives can be played.
pub fn run(options: &DevicesOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let ask = Ask { server: options.server.clone() };
    output::perform(common.json, &ask, devices::run)
}
