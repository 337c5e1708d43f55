//! `unripple devices`: what drives can be played through.

use crate::args::DevicesOptions;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::devices::{self, Ask};

pub fn run(options: &DevicesOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask { server: options.server.clone() };
    output::report(as_json, &devices::run(&ask, &mut Terminal::default())?)
}
