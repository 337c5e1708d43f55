//! `unripple focus`: computes a drive, with its report and figures.

use crate::args::FocusOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::output;
use crate::typed::{self, each, milli, places, seconds};
use unripple_tasks::{focus, stroke, text_forms, waveform};

/// Computes a drive that focuses, or one for waveforms or a stroke, as the options say.
pub fn run(options: &FocusOptions, common: &Common) -> Result<(), CliError> {
    check(options)?;
    let targets = &options.targets;
    if let Some(path) = &targets.path {
        output::perform(common.json, &stroke_ask(common, options, path)?, stroke::run)
    } else if !targets.waveform.is_empty() {
        output::perform(common.json, &waveform_ask(common, options)?, waveform::run)
    } else {
        output::perform(common.json, &ask(common, options)?, focus::run)
    }
}

/// Refuses combinations of options that are not possible.
fn check(options: &FocusOptions) -> Result<(), CliError> {
    let targets = &options.targets;
    let (waves, path) = (!targets.waveform.is_empty(), targets.path.is_some());
    let levelled = targets.peak_um.is_some() || targets.felt_db.is_some() || targets.full_limit;
    let bare = targets.at.is_empty() && targets.shape.is_empty() && !levelled;
    let paced = targets.speed_mm_s.is_some() || targets.level_mm_s.is_some();
    let wrong = [
        (waves && path, "--waveform: expected no --path beside it, found one"),
        (
            !waves && !targets.silent.is_empty(),
            "--silent: expected --waveform X,Y,WHAT beside it, found none",
        ),
        (!path && paced, "--speed-mm-s, --level-mm-s: expected --path beside them, found none"),
        (
            (waves || path) && !bare,
            "--waveform, --path: expected no --at, --shape, --peak-um, --felt-db or --full-limit beside them, found one",
        ),
        (
            (waves || path) && !options.finger.is_empty(),
            "--waveform, --path: expected no --finger beside them, found one",
        ),
        (
            (waves || path) && options.listen_m.is_some(),
            "--waveform, --path: expected no --listen-m beside them, found one",
        ),
    ];
    match wrong.into_iter().find(|(is_so, _)| *is_so) {
        Some((_, text)) => Err(CliError::Input(text.into())),
        None => Ok(()),
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
        points: options.targets.points()?,
        shapes: options.targets.shapes()?,
        level: options.targets.level()?,
        method: options.method.into(),
        strength: options.strength,
        push: options.push,
        total_rms: options.total_rms,
        spread: options.spread_percent / 100.0,
        worst: options.worst,
        economy: options.economy,
        rest: options.rest,
        window_s: seconds(options.window_ms, "--window-ms")?,
        between: options.between.into(),
        losses: options.losses.into(),
        duration_s: seconds(options.duration_ms, "--duration-ms")?,
        fingers_m: places(&options.finger, "--finger")?,
        finger_aware: options.finger_aware,
        bear_tension: options.bear_tension_percent.map(|percent| percent / 100.0),
        bear_fingers_m: places(&options.bear_finger, "--bear-finger")?,
        on: options.on.as_ref().map(Into::into),
        judge_hz: options.judge_hz,
        listen_m: options.listen_m,
        output: Some(options.output.clone()),
        no_figures: options.figures.no_figures,
        columns: options.figures.columns,
    })
}

fn waveform_ask(common: &Common, options: &FocusOptions) -> Result<waveform::Ask, CliError> {
    Ok(waveform::Ask {
        surface: common.surface(&options.surface),
        waveforms: each(&options.targets.waveform, "--waveform", text_forms::waveform)?,
        silent_m: places(&options.targets.silent, "--silent")?,
        window_s: seconds(options.window_ms, "--window-ms")?,
        on: options.on.as_ref().map(Into::into),
        judge_hz: options.judge_hz,
        output: Some(options.output.clone()),
        no_figures: options.figures.no_figures,
        columns: options.figures.columns,
    })
}

fn stroke_ask(common: &Common, options: &FocusOptions, path: &str) -> Result<stroke::Ask, CliError> {
    let Some(speed_m_s) = milli(options.targets.speed_mm_s, "--speed-mm-s", "mm/s")? else {
        return Err(CliError::Input("--path: expected --speed-mm-s V beside it, found none".into()));
    };
    let level_m_s = milli(options.targets.level_mm_s, "--level-mm-s", "mm/s")?;
    Ok(stroke::Ask {
        surface: common.surface(&options.surface),
        path: typed::of("--path", text_forms::path(path))?,
        speed_m_s,
        level_m_s: level_m_s.unwrap_or(stroke::Ask::default().level_m_s),
        window_s: seconds(options.window_ms, "--window-ms")?,
        on: options.on.as_ref().map(Into::into),
        judge_hz: options.judge_hz,
        output: Some(options.output.clone()),
        no_figures: options.figures.no_figures,
        columns: options.figures.columns,
    })
}
