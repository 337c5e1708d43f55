//! `unripple modes`: frequencies and decay times.

use crate::args::ModesOptions;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::modes::{self, Ask};

pub fn run(options: &ModesOptions, as_json: bool) -> Result<(), CliError> {
    let ModesOptions { surface, max_hz, accuracy } = options;
    let ask = Ask { surface: surface.into(), top_hz: *max_hz, accuracy: *accuracy };
    output::report(as_json, &modes::run(&ask, &mut Terminal::default())?)
}
