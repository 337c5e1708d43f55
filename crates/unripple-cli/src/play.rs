//! `unripple play`: a surface that answers fingers, live.

use crate::args::PlayOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::play::{self, Ask};

/// Plays a surface under moving fingers.
pub fn run(options: &PlayOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        device: options.device.ask(),
        effect: options.effect.clone(),
        touch: options.touch.ask(),
        method: options.method.method(),
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
    let played = play::run(&ask, &mut Terminal::that_stops());
    output::report(common.json, &played?)
}
