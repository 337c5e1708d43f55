//! `unripple design`: every tradeoff of a surface before anything is built.

use crate::args::DesignOptions;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::design::{self, Ask};

pub fn run(options: &DesignOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask { surface: (&options.surface).into() };
    output::report(as_json, &design::run(&ask, &mut Terminal::default())?)
}
