//! `unripple reproduce`: the paper's table and figures beside ours, as one page.

use crate::args::ReproduceOptions;
use crate::error::CliError;
use crate::output;
use unripple_paper::reproduce::{self, Ask};

pub fn run(options: &ReproduceOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask { output: Some(options.output.clone()), placements: options.placements };
    output::perform(as_json, &ask, reproduce::run)
}
