//! `unripple compare`: every method on the same targets.

use crate::args::CompareOptions;
use crate::error::CliError;
use crate::output;
use crate::targets::{self, seconds};
use unripple_tasks::compare::{self, Ask};

pub fn run(options: &CompareOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask {
        surface: (&options.surface).into(),
        points: targets::points(&options.targets)?,
        shapes: targets::shapes(&options.targets)?,
        level: targets::level(&options.targets)?,
        window_s: seconds(options.window_ms, "--window-ms")?,
        judge_hz: options.judge_hz,
        output: options.output.clone(),
    };
    output::perform(as_json, &ask, compare::run)
}
