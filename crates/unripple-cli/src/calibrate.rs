//! `unripple calibrate`: measures responses through a device, point by point, into a library.

use crate::args::CalibrateOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::{Bar, Terminal};
use crate::typed::{each, metres, of, places, seconds};
use std::io::{BufRead, Write};
use unripple_tasks::calibrate::{self, Ask, Hands};
use unripple_tasks::{observed, text_forms};

/// Measures responses; on a real device the user is asked to move the probe or to tap.
pub fn run(options: &CalibrateOptions, common: &Common) -> Result<(), CliError> {
    let ask = ask(common, options)?;
    let record = output::record(common.json, &ask)?;
    let mut terminal = Terminal::default();
    let hands = by_hand(terminal.bar());
    let done = observed(&mut terminal, |progress| calibrate::run_with(&ask, hands, progress));
    drop(terminal);
    output::recorded(&done?, record.as_ref())
}

fn ask(common: &Common, options: &CalibrateOptions) -> Result<Ask, CliError> {
    let pitch_m = metres(options.grid_mm, "--grid-mm")?;
    if let Some(delay) = options.probe_delay_ms.filter(|delay| !delay.is_finite()) {
        return Err(CliError::Input(format!(
            "--probe-delay-ms: expected a finite time in ms, found {delay}"
        )));
    }
    Ok(Ask {
        surface: common.surface(&options.surface),
        device: options.device.ask(),
        pitch_m,
        points_m: places(&options.at, "--at")?,
        by: options.by.into(),
        repeats: options.repeats,
        sweep_s: seconds(options.sweep_ms, "--sweep-ms")?,
        response_s: seconds(options.response_ms, "--response-ms")?,
        level: options.level,
        wires: each(&options.wire, "--wire", text_forms::wire)?,
        input_scales: of("--input-scale", text_forms::input_scales(&options.input_scale))?,
        without: options.without.clone(),
        probe_delay_s: options.probe_delay_ms.map(|ms| ms / 1e3),
        table: options.table.clone(),
        no_model: options.no_model,
        resample: options.resample,
        check_levels: options.check_levels,
        any_wiring: options.any_wiring,
        figure: options.figure.clone(),
        output: options.output.clone(),
    })
}

/// Says on standard error what to do, and waits for Enter once it is done.
pub fn by_hand(bar: Bar) -> Hands {
    Box::new(move |asked| {
        bar.aside(|| {
            let mut out = std::io::stderr().lock();
            write!(out, "{asked}, then press Enter: ")
                .and_then(|()| out.flush())
                .map_err(|e| e.to_string())?;
            match std::io::stdin().lock().read_line(&mut String::new()) {
                Ok(0) => Err("nobody can press Enter: standard input has ended".into()),
                Ok(_) => Ok(()),
                Err(error) => Err(error.to_string()),
            }
        })
    })
}
