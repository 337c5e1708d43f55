//! `unripple doctor`: each stage between a touch and what is felt, checked in turn.

use crate::args::DoctorOptions;
use crate::error::CliError;
use crate::output;
use unripple_tasks::doctor::{self, Ask};

pub fn run(options: &DoctorOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask {
        surface: (&options.surface).into(),
        device: options.device.ask(),
        tuio: options.tuio,
        listen: options.listen,
    };
    output::perform(as_json, &ask, doctor::run)
}
