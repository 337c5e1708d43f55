//! `unripple field`: evaluates the motion of a surface under any drive.

use crate::args::FieldOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::typed::{of, places, seconds};
use unripple_tasks::field::{self, Ask, DriveAsk};
use unripple_tasks::text_forms;

/// Measures what a drive does to a surface.
pub fn run(options: &FieldOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        drive: DriveAsk::File(options.drive.clone()),
        points_m: places(&options.at, "--at")?,
        instants_s: options.at_ms.iter().map(|ms| ms / 1e3).collect(),
        fingers_m: places(&options.finger, "--finger")?,
        period_s: seconds(options.period_ms, "--period-ms")?,
        judge_hz: options.judge_hz,
        output: options.output.clone(),
        no_figures: options.no_figures,
        columns: options.columns,
        movie_s: of("--movie-ms", options.movie_ms.as_deref().map(text_forms::interval).transpose())?,
        frames: options.frames,
        between: options.between.interpolation(),
    };
    output::perform(common.json, &ask, field::run)
}
