//! `unripple reproduce`: reproduces the paper's table and figures beside ours, as one page.

use crate::args::ReproduceOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_paper::reproduce::{self, Ask};

/// Computes the paper's table and figures again.
pub fn run(options: &ReproduceOptions, common: &Common) -> Result<(), CliError> {
    common.without_surface()?;
    let ask = Ask { output: Some(options.output.clone()), placements: options.placements };
    output::perform(common.json, &ask, reproduce::run)
}
