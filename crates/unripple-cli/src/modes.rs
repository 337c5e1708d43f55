//! `unripple modes`: frequencies and decay times.

use crate::args::ModesOptions;
use crate::error::CliError;
use crate::output;
use unripple_tasks::modes::{self, Ask};

pub fn run(options: &ModesOptions, as_json: bool) -> Result<(), CliError> {
    let ModesOptions { surface, max_hz, accuracy } = options;
    let ask = Ask { surface: surface.into(), top_hz: *max_hz, accuracy: *accuracy };
    output::perform(as_json, &ask, modes::run)
}
