//! `unripple calibrate`: measures responses through a device, point by point, into a library.

use crate::args::{CalibrateOptions, WayName};
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::progress::{Bar, Terminal};
use crate::targets::{places, positive, seconds};
use std::io::{BufRead, Write};
use unripple_tasks::calibrate::{self, Ask, By, Hands, InputScales};
use unripple_tasks::observed;

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
    let pitch = options.grid_mm.map(|mm| positive(mm, "--grid-mm", "mm")).transpose()?;
    if let Some(delay) = options.probe_delay_ms.filter(|delay| !delay.is_finite()) {
        return Err(CliError::Input(format!(
            "--probe-delay-ms: expected a finite time in ms, found {delay}"
        )));
    }
    Ok(Ask {
        surface: common.surface(&options.surface),
        device: options.device.ask(),
        pitch_m: pitch.map(|mm| mm / 1e3),
        points_m: places(&options.at, "--at")?,
        by: match options.by {
            WayName::Probe => By::Probe,
            WayName::Tap => By::Tap,
        },
        repeats: options.repeats,
        sweep_s: seconds(options.sweep_ms, "--sweep-ms")?,
        response_s: seconds(options.response_ms, "--response-ms")?,
        level: options.level,
        wires: options.wire.iter().map(|text| wire(text)).collect::<Result<_, _>>()?,
        input_scales: scales(&options.input_scale)?,
        without: options.without.clone(),
        probe_delay_s: options.probe_delay_ms.map(|ms| ms / 1e3),
        no_model: options.no_model,
        resample: options.resample,
        check_levels: options.check_levels,
        any_wiring: options.any_wiring,
        figure: options.figure.clone(),
        output: options.output.clone(),
    })
}

/// Parses a channel that has another name than its actuator, sensor or probe: `a1=system:playback_3`.
fn wire(text: &str) -> Result<(String, String), CliError> {
    match text.split_once('=') {
        Some((name, channel)) if !name.is_empty() && !channel.is_empty() => {
            Ok((name.to_owned(), channel.to_owned()))
        }
        _ => Err(CliError::Input(format!("--wire {text}: expected NAME=CHANNEL, found `{text}`"))),
    }
}

/// Parses the scales of inputs: `probe=0.5`, or without a name the scale of all inputs.
fn scales(typed: &[String]) -> Result<InputScales, CliError> {
    let mut scales = InputScales::default();
    for text in typed {
        let (name, number) = text.split_once('=').map_or((None, text.as_str()), |(name, n)| (Some(name), n));
        let scale = match number.trim().parse::<f64>() {
            Ok(scale) if scale.is_finite() && scale != 0.0 => scale,
            _ => {
                return Err(CliError::Input(format!(
                    "--input-scale {text}: expected a number other than 0, as in probe=0.5, found {number}"
                )));
            }
        };
        match name {
            Some(name) => drop(scales.named.insert(name.into(), scale)),
            None => scales.all = Some(scale),
        }
    }
    Ok(scales)
}

/// Says on standard error what to do, and waits for Enter once it is done.
fn by_hand(bar: Bar) -> Hands {
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
