//! `unripple respond`: responses from the model, as a library.

use crate::args::RespondOptions;
use crate::error::CliError;
use crate::output;
use crate::targets::{positive, seconds};
use unripple_tasks::respond::{self, Ask};

pub fn run(options: &RespondOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask {
        surface: (&options.surface).into(),
        pitch_m: positive(options.grid_mm, "--grid-mm", "mm")? / 1e3,
        length_s: seconds(options.length_ms, "--length-ms")?,
        output: options.output.clone(),
    };
    output::perform(as_json, &ask, respond::run)
}
