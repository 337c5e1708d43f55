//! `unripple compare`: compares all focusing methods on the same targets.

use crate::args::CompareOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::targets::{self, seconds};
use unripple_tasks::compare::{self, Ask};

/// Compares all methods on the same targets.
pub fn run(options: &CompareOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        points: targets::points(&options.targets)?,
        shapes: targets::shapes(&options.targets)?,
        level: targets::level(&options.targets)?,
        window_s: seconds(options.window_ms, "--window-ms")?,
        judge_hz: options.judge_hz,
        // They take half of the time, and no table shows them.
        no_tradeoffs: !(common.json || options.output.is_some()),
        no_figures: options.no_figures,
        columns: options.columns,
        output: options.output.clone(),
    };
    output::perform(common.json, &ask, compare::run)
}
