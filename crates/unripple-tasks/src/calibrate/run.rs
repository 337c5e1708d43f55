//! Measures responses, through a device or by recordings made elsewhere, and stores them in a library.

use super::campaign::Campaign;
use super::points::Places;
use super::scale::Scales;
use super::{Ask, By, Hands, Report, figure, live, nobody, tape};
use crate::numbers::above_zero;
use crate::{DeviceKind, Progress, TaskError, go_on, judge};
use std::cell::RefCell;
use unripple::core::{ModalResponses, Responses, Surface};
use unripple_calibrate::measure::{MOST_KEPT, MOST_REPEATS, MeasureOptions};
use unripple_store::Library;

/// Measures responses through a device and stores them in a library. With recordings made elsewhere (tape)
/// it writes the file to play, then reads the recordings. It is for devices that need no person at the
/// surface; for others use [`run_with`].
///
/// # Errors
/// Those of [`run_with`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    run_with(ask, nobody(), progress)
}

/// Measures responses as [`run()`] does, and calls `hands` to ask a person to move the probe or to tap. A
/// cancelled run leaves the library as it is, to be continued.
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; those of surfaces, devices, files and measurements; [`TaskError::Cancelled`].
pub fn run_with(ask: &Ask, hands: Hands, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let surface = ask.surface.load()?;
    let scales = Scales::of(ask, &surface)?;
    check(ask, &surface, &scales)?;
    Library::may_be_at(&ask.output)?;
    let figure = figure::place(ask)?;
    go_on(progress)?;
    progress.stage("modes");
    let Responses::Modal(model) = judge::model(&surface, None, &[])? else {
        return Err(TaskError::Input("expected a surface, found responses at points".into()));
    };
    let settings = settings(ask, &surface, &model)?;
    let (places, progress) = (Places::default(), RefCell::new(progress));
    let campaign =
        Campaign { ask, surface: &surface, model: &model, settings, scales, places, figure, progress };
    match ask.device.device {
        DeviceKind::Tape => tape::run(campaign),
        _ => live::run(campaign, hands),
    }
}

/// Returns an error for numbers that make no sense, before the model is computed.
fn check(ask: &Ask, surface: &Surface, scales: &Scales) -> Result<(), TaskError> {
    let level = above_zero(ask.level, "level", "of the limit")?;
    if !(1..=MOST_REPEATS).contains(&ask.repeats) {
        return Err(TaskError::ask("repeats", format!("1 to {MOST_REPEATS}"), ask.repeats));
    }
    if let Some(kept) = ask.response_s.filter(|kept| *kept > MOST_KEPT) {
        return Err(TaskError::ask("response_s", format!("at most {MOST_KEPT} s"), format!("{kept} s")));
    }
    if ask.table.is_some() && (ask.device.device != DeviceKind::Tape || ask.by == By::Probe) {
        return Err(TaskError::ask(
            "table",
            "`device` tape and `by` tap or hammer beside it",
            "another device or way",
        ));
    }
    within(level, scales, surface)?;
    without(ask, surface).map(drop)
}

/// Options of the measurement: as requested, and by default as they suit the decay times of the model.
fn settings(ask: &Ask, surface: &Surface, model: &ModalResponses) -> Result<MeasureOptions, TaskError> {
    let usual = MeasureOptions::for_model(model);
    let length = |value: Option<f64>, usual: f64, field: &'static str| {
        value.map_or(Ok(usual), |value| above_zero(value, field, "s"))
    };
    if let Some(delay) = ask.probe_delay_s.filter(|delay| !delay.is_finite()) {
        return Err(TaskError::Input(format!("`probe_delay_s`: expected a finite time in s, found {delay}")));
    }
    Ok(MeasureOptions {
        sweep: length(ask.sweep_s, usual.sweep, "sweep_s")?,
        response_length: length(ask.response_s, usual.response_length, "response_s")?,
        level: above_zero(ask.level, "level", "of the limit")?,
        repeats: ask.repeats,
        probe_delay: ask.probe_delay_s,
        model: !ask.no_model,
        without: without(ask, surface)?,
        ..usual
    })
}

/// Indices of the actuators that are not to be measured.
fn without(ask: &Ask, surface: &Surface) -> Result<Vec<usize>, TaskError> {
    let names = || surface.actuators.iter().map(|actuator| actuator.name.as_str());
    let mut found = Vec::new();
    for name in &ask.without {
        match names().position(|other| other == name) {
            Some(actuator) => found.push(actuator),
            None => {
                let names = names().collect::<Vec<_>>().join(", ");
                return Err(TaskError::Input(format!(
                    "`without` {name}: expected one of {names}, found another"
                )));
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    if found.len() == surface.actuators.len() {
        return Err(TaskError::Input("`without`: expected an actuator that is left, found none".into()));
    }
    Ok(found)
}

/// Returns an error for a drive above full scale.
fn within(level: f64, scales: &Scales, surface: &Surface) -> Result<(), TaskError> {
    if level > 1.0 {
        return Err(TaskError::Input(format!("`level`: expected at most 1, found {level}")));
    }
    let (limit, full) = (surface.emission.limit, scales.full_scale(surface));
    if level * limit <= full * (1.0 + 1e-9) {
        return Ok(());
    }
    let most = full / limit;
    Err(TaskError::Input(format!(
        "`level`: expected at most {most:.3}, since `output_scale` {full} is less than the surface's limit of {limit}, found {level}"
    )))
}
