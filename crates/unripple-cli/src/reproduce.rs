//! `unripple reproduce`: the paper's table and figures beside ours, as one page.

use crate::args::ReproduceOptions;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_paper::reproduce::{self, Ask};

pub fn run(options: &ReproduceOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask { output: Some(options.output.clone()), placements: options.placements };
    output::report(as_json, &reproduce::run(&ask, &mut Terminal::default())?)
}
