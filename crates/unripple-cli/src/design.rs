//! `unripple design`: every tradeoff of a surface before anything is built.

use crate::args::DesignOptions;
use crate::error::CliError;
use crate::output;
use unripple_tasks::design::{self, Ask};

pub fn run(options: &DesignOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask { surface: (&options.surface).into() };
    output::perform(as_json, &ask, design::run)
}
