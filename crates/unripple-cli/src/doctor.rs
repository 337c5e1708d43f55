//! `unripple doctor`: checks each stage between a touch and what is felt.

use crate::args::DoctorOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::doctor::{self, Ask};

/// Checks each stage between a touch and what is felt.
pub fn run(options: &DoctorOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        device: options.device.ask(),
        tuio: options.tuio,
        listen: options.listen,
    };
    output::perform(common.json, &ask, doctor::run)
}
