//! `unripple play`: drives a surface live, in answer to touches.

use crate::args::PlayOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::play::{self, Ask};

/// Plays a surface live, in answer to touches.
pub fn run(options: &PlayOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        device: options.device.ask(),
        effect: options.effect.clone(),
        touch: options.touch.ask(),
        method: options.method.into(),
        // Looked at by the task, after the files that are to be written.
        window_s: options.window_ms.map(|ms| ms / 1e3),
        block: options.block,
        seconds: options.seconds,
        full_limit: options.full_limit,
        follow_tension: options.follow_tension,
        real_time: options.real_time,
        drift: options.drift_percent.map(|percent| percent / 100.0),
        keep_drive: options.keep_drive.clone(),
    };
    let record = output::record(common.json, &ask)?;
    let played = play::run(&ask, &mut Terminal::that_stops());
    output::recorded(&played?, record.as_ref())
}
