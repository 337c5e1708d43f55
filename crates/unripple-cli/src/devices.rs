//! `unripple devices`: what drives can be played through.

use crate::args::DevicesOptions;
use crate::error::CliError;
use crate::output;
use unripple_tasks::devices::{self, Ask};

pub fn run(options: &DevicesOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask { server: options.server.clone() };
    output::perform(as_json, &ask, devices::run)
}
