//! `unripple fit`: of a library, or with `--modes` of a surface to natural frequencies.

use crate::args::FitOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::{fit, fit_modes};

/// Fits the model to a library, or a surface to frequencies.
pub fn run(options: &FitOptions, common: &Common) -> Result<(), CliError> {
    match options.of_modes(common)? {
        Some(ask) => output::perform(common.json, &ask, fit_modes::run),
        None => output::perform(common.json, &options.ask(common)?, fit::run),
    }
}
