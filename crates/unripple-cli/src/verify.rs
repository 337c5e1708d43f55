//! `unripple verify`: plays a drive, and prints what a probe records beside the prediction.

use crate::args::VerifyOptions;
use crate::calibrate::by_hand;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::Terminal;
use unripple_tasks::{observed, verify};

/// Plays and compares; on a real device the user is asked to move the probe.
pub fn run(options: &VerifyOptions, common: &Common) -> Result<(), CliError> {
    let ask = options.ask(common)?;
    let record = output::record(common.json, &ask)?;
    let mut terminal = Terminal::default();
    let hands = by_hand(terminal.bar());
    let done = observed(&mut terminal, |progress| verify::run_with(&ask, hands, progress));
    drop(terminal);
    output::recorded(&done?, record.as_ref())
}
