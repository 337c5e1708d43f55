//! `unripple drift`: measures how much a sheet's tension differs from the one that its responses assume.

use crate::args::DriftOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use unripple_tasks::drift::{self, Ask};

/// Prints whether a sheet's tension has changed.
pub fn run(options: &DriftOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        device: options.device.ask(),
        seconds: options.seconds,
        range: options.within_percent / 100.0,
        changed: options.changed_percent / 100.0,
        changing_per_min: options.changing_percent_per_min / 100.0,
    };
    output::perform(common.json, &ask, drift::run)
}
