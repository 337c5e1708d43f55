//! Measurement of a sheet's tension by pings.

use super::known::Known;
use super::ping_device::PingDevice;
use super::report::{Report, Step};
use super::{Ask, Cost};
use crate::{DeviceKind, Progress, TaskError, go_on};
use std::f64::consts::TAU;
use unripple_calibrate::{Ping, PingOptions, Tracker};

/// Length of an observation, in s: a ping, and its decay.
const PERIOD: f64 = 0.4;

/// Shortest and longest duration of the measurement, in s: a rate needs three pings.
const SECONDS: [f64; 2] = [1.2, 3600.0];

/// Largest relative change of tension that can be searched for: beyond, another sheet is meant.
const MOST: f64 = 0.5;

/// Relative error of the law by which modes depend on tension: it uses the bending share of each mode
/// before the change, which is right to first order in the change; for a fit that share is known to 1e-3.
const LAW: f64 = 1e-3;

/// Further relative error of the tension of a fitted model: as large as it was on a virtual film in a band of 1 kHz.
const FITTED: f64 = 1.5e-3;

/// Measures by how much a sheet's tension differs from the one that its responses assume, and whether it keeps changing.
///
/// ```
/// use unripple_tasks::{Silent, drift};
/// use unripple_tasks::drift::Verdict;
///
/// let ask = drift::Ask { seconds: 1.2, changed: 0.005, ..drift::Ask::default() };
/// let report = drift::run(&ask, &mut Silent)?;
/// assert_eq!(report.verdict, Verdict::Steady);
/// assert!((report.change.unwrap() - 0.005).abs() < 3.0 * report.change_error.unwrap());
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Ask`] of numbers that make no sense; those of surfaces, libraries, fits and devices; [`TaskError::Input`] of a library
/// without sensors at its actuators; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    check(ask)?;
    go_on(progress)?;
    let known = Known::of(&ask.surface, progress)?;
    go_on(progress)?;
    progress.stage("device");
    let mut device = PingDevice::open(ask, &known, progress)?;
    let limit = known.surface.emission.limit;
    let options = PingOptions { band: known.ping_band(), limit, ..PingOptions::default() };
    let mut ping = Ping::design(&known.modal, &options)?;
    known.dead.iter().for_each(|actuator| ping.drive[*actuator].fill(0.0));
    ping.drive = device.as_sent(&ping.drive);
    go_on(progress)?;
    progress.stage("noise");
    let noise = device.noise(progress)?;
    // No noise at all is none that is known.
    let mut tracker = known.tracker(&ping.drive, noise.max(f64::MIN_POSITIVE.sqrt()), ask.range)?;
    let steps = follow(ask, &mut device, &mut tracker, &ping, progress)?;
    go_on(progress)?;
    progress.stage("focus");
    let missed = missed(&known, &options);
    let mut report = Report::of(&known, &ping, steps, (missed, LAW));
    (report.noise, report.latency_samples) = (noise, device.latency);
    if report.change.is_some() {
        report.focus = Some(Cost::of(&known.surface, &known.modal, tracker.responses(0.0))?);
    }
    Ok(report)
}

/// Returns an error for numbers that make no sense, before any long computation.
fn check(ask: &Ask) -> Result<(), TaskError> {
    let [least, most] = SECONDS;
    if !(least..=most).contains(&ask.seconds) {
        return Err(TaskError::ask("seconds", format!("{least} to {most} s"), ask.seconds));
    }
    if !(ask.range > 0.0 && ask.range <= MOST) {
        return Err(TaskError::ask("range", format!("a share above 0, at most {MOST}"), ask.range));
    }
    let virtually = [("changed", ask.changed), ("changing_per_min", ask.changing_per_min)];
    for (field, share) in virtually.into_iter().filter(|(_, share)| *share != 0.0) {
        if ask.device.device != DeviceKind::Virtual {
            return Err(TaskError::ask(field, "the virtual device, whose tension can be chosen", "another"));
        }
        if !(share.is_finite() && share.abs() <= MOST) {
            return Err(TaskError::ask(field, format!("a share of at most {MOST}, up or down"), share));
        }
    }
    Ok(())
}

/// Plays the pings, and returns an estimate of the tension after each.
fn follow(
    ask: &Ask,
    device: &mut PingDevice,
    tracker: &mut Tracker,
    ping: &Ping,
    progress: &mut dyn Progress,
) -> Result<Vec<Step>, TaskError> {
    progress.stage("pings");
    let (period, count) = (device.samples(PERIOD), (ask.seconds / PERIOD).round() as usize);
    let mut steps = Vec::with_capacity(count);
    for n in 1..=count {
        let heard = device.listen(&ping.drive, period, progress)?;
        let drift = tracker.observe(&ping.drive, &heard)?;
        steps.push(Step::of(n as f64 * PERIOD, &drift));
        progress.done(n as f64 / count as f64);
    }
    Ok(steps)
}

/// Relative change of tension that the model's error may be mistaken for: a mode with decay time τ shows
/// the tension by a phase of ωτ/2, and the errors of the modes in the ping's band are independent.
fn missed(known: &Known, ping: &PingOptions) -> f64 {
    let top = known.modal.conditions.band[1];
    let [low, high] = ping.band.map(|share| TAU * share * top);
    let within = known.modal.poles.iter().filter(|pole| (low..=high).contains(&pole.omega));
    let phases: Vec<f64> = within.map(|pole| 0.5 * pole.omega / pole.sigma.max(1.0)).collect();
    let modes = phases.len().max(1) as f64;
    let phase = match phases.is_empty() {
        true => 0.5 * low * ping.length,
        false => phases.iter().sum::<f64>() / modes,
    };
    let own = known.unexplained() / (phase * modes.sqrt());
    if known.is_fitted() { own.hypot(FITTED) } else { own }
}
