//! `unripple doctor`: each stage between a touch and what is felt, checked in turn.

use crate::args::DoctorOptions;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::doctor::{self, Ask};

pub fn run(options: &DoctorOptions, as_json: bool) -> Result<(), CliError> {
    let ask = Ask {
        surface: (&options.surface).into(),
        device: options.device.ask(),
        tuio: options.tuio,
        listen: options.listen,
    };
    output::report(as_json, &doctor::run(&ask, &mut Terminal::default())?)
}
