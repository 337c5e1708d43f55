//! `unripple respond`: computes responses from the model, as a library.

use crate::args::RespondOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::typed::{positive, seconds};
use unripple_tasks::respond::{self, Ask};

/// Computes a library of responses from the model.
pub fn run(options: &RespondOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        pitch_m: positive(options.grid_mm, "--grid-mm", "mm")? / 1e3,
        length_s: seconds(options.length_ms, "--length-ms")?,
        output: options.output.clone(),
    };
    output::perform(common.json, &ask, respond::run)
}
