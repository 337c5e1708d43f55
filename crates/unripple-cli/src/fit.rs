//! `unripple fit`: fits the model to the responses between a library's actuators.

use crate::args::FitOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::typed::{metres, places};
use unripple_tasks::fit::{self, Ask};

/// Fits a model to a library.
pub fn run(options: &FitOptions, common: &Common) -> Result<(), CliError> {
    let accuracy = common.accuracy_alone()?;
    let ask = Ask {
        library: options.library.clone().into(),
        pitch_m: metres(options.grid_mm, "--grid-mm")?,
        points_m: places(&options.at, "--at")?,
        strays: options.strays,
        profile: options.profile,
        even_if_doubtful: options.even_if_doubtful,
        accuracy,
        output: options.output.clone(),
    };
    output::perform(common.json, &ask, fit::run)
}
