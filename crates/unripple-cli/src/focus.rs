//! `unripple focus`: computes a drive, with its report and figures.

use crate::args::{FocusOptions, LossName};
use crate::common::Common;
use crate::error::CliError;
use crate::targets::{self, places, seconds};
use crate::{output, waveforms};
use unripple_tasks::focus::{self, Losses};
use unripple_tasks::{stroke, waveform};

/// Computes a drive that focuses, or one for waveforms or a stroke, as the options say.
pub fn run(options: &FocusOptions, common: &Common) -> Result<(), CliError> {
    waveforms::check(options)?;
    let targets = &options.targets;
    if let Some(path) = &targets.path {
        output::perform(common.json, &stroke_ask(common, options, path)?, stroke::run)
    } else if !targets.waveform.is_empty() {
        output::perform(common.json, &waveform_ask(common, options)?, waveform::run)
    } else {
        output::perform(common.json, &ask(common, options)?, focus::run)
    }
}

fn ask(common: &Common, options: &FocusOptions) -> Result<focus::Ask, CliError> {
    if let Some(percent) = options.bear_tension_percent
        && !(percent > 0.0 && percent < 50.0)
    {
        return Err(CliError::Input(format!(
            "--bear-tension-percent: expected a number above 0 and below 50, found {percent}"
        )));
    }
    Ok(focus::Ask {
        surface: common.surface(&options.surface),
        points: targets::points(&options.targets)?,
        shapes: targets::shapes(&options.targets)?,
        level: targets::level(&options.targets)?,
        method: options.method.method(),
        strength: options.strength,
        push: options.push,
        total_rms: options.total_rms,
        spread: options.spread_percent / 100.0,
        worst: options.worst,
        economy: options.economy,
        rest: options.rest,
        window_s: seconds(options.window_ms, "--window-ms")?,
        between: options.between.interpolation(),
        losses: match options.losses {
            LossName::None => Losses::None,
            LossName::Uniform => Losses::Uniform,
            LossName::PerMode => Losses::PerMode,
        },
        duration_s: seconds(options.duration_ms, "--duration-ms")?,
        fingers_m: places(&options.finger, "--finger")?,
        finger_aware: options.finger_aware,
        bear_tension: options.bear_tension_percent.map(|percent| percent / 100.0),
        bear_fingers_m: places(&options.bear_finger, "--bear-finger")?,
        on: options.on.as_ref().map(Into::into),
        judge_hz: options.judge_hz,
        output: Some(options.output.clone()),
        no_figures: options.no_figures,
        columns: options.columns,
    })
}

fn waveform_ask(common: &Common, options: &FocusOptions) -> Result<waveform::Ask, CliError> {
    Ok(waveform::Ask {
        surface: common.surface(&options.surface),
        waveforms: waveforms::waveforms(&options.targets)?,
        silent_m: places(&options.targets.silent, "--silent")?,
        window_s: seconds(options.window_ms, "--window-ms")?,
        on: options.on.as_ref().map(Into::into),
        judge_hz: options.judge_hz,
        output: Some(options.output.clone()),
        no_figures: options.no_figures,
        columns: options.columns,
    })
}

fn stroke_ask(common: &Common, options: &FocusOptions, path: &str) -> Result<stroke::Ask, CliError> {
    let (path, speed_m_s, level_m_s) = waveforms::stroke(&options.targets, path)?;
    Ok(stroke::Ask {
        surface: common.surface(&options.surface),
        path,
        speed_m_s,
        level_m_s,
        window_s: seconds(options.window_ms, "--window-ms")?,
        on: options.on.as_ref().map(Into::into),
        judge_hz: options.judge_hz,
        output: Some(options.output.clone()),
        no_figures: options.no_figures,
        columns: options.columns,
    })
}
