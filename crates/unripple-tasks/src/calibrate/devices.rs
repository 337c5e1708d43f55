//! Opens the device that a request names, for a calibration.

use super::rigs::{HandRig, People, VirtualRig};
use crate::TaskError;
use crate::{DeviceAsk, DeviceKind};
use crate::{device, judge};
use unripple::core::{FORCE, PROBE, Surface};
use unripple::physics::stepper::InjectedFaults;
use unripple_calibrate::measure::Rig;
use unripple_devices::{DevicesError, Jack, Perturbation, VirtualOptions};

/// An open device, with the simulation or the people that move its probe.
pub struct Opened {
    /// The device, and the simulation or person that moves its probe or taps.
    pub rig: Box<dyn Rig>,
    /// How the virtual surface differs from its file, in words; `None` if it does not, or for a real
    /// device.
    pub truth: Option<String>,
}

/// A failure of the device, or a device that does not fit.
fn failed(error: DevicesError) -> TaskError {
    match error {
        DevicesError::Jack { .. } | DevicesError::Card { .. } | DevicesError::Device(_) => {
            TaskError::work(error)
        }
        error => TaskError::input(error),
    }
}

/// Opens the device that a request names; on a real device `people` are asked to move the probe or to tap.
pub fn open(options: &DeviceAsk, surface: &Surface, people: People) -> Result<Opened, TaskError> {
    open_under(options, surface, people, Vec::new())
}

/// Opens the device that a request names, as [`open`] does; `tension` is a table of time (s) and the
/// tension of a virtual surface relative to its nominal tension (ratio).
pub fn open_under(
    options: &DeviceAsk,
    surface: &Surface,
    people: People,
    tension: Vec<(f64, f64)>,
) -> Result<Opened, TaskError> {
    let faults = InjectedFaults { tension, ..InjectedFaults::default() };
    open_with(options, surface, people, faults, None)
}

/// Opens the device that a request names, as [`open`] does; a virtual surface gets these faults, and modes up to `max_hz` (Hz; by default
/// those that its band needs).
pub fn open_with(
    options: &DeviceAsk,
    surface: &Surface,
    people: People,
    faults: InjectedFaults,
    max_hz: Option<f64>,
) -> Result<Opened, TaskError> {
    match options.device {
        DeviceKind::Virtual => {
            let plain = VirtualOptions { faults, max_hz, hammer: people.hammer, ..to_be_measured(surface)? };
            virtual_surface(options, surface, &plain)
        }
        DeviceKind::Jack => jack(options, surface, people),
        DeviceKind::Card => card(options, surface, people),
        DeviceKind::Tape => Err(TaskError::Input(
            "`device` tape: expected a device that plays and listens at once, found files".into(),
        )),
    }
}

/// What a virtual surface is like where nothing else is asked for.
fn to_be_measured(surface: &Surface) -> Result<VirtualOptions, TaskError> {
    let plain = VirtualOptions::to_be_measured(surface).map_err(failed)?;
    Ok(VirtualOptions { accuracy: judge::accuracy(surface), ..plain })
}

fn virtual_surface(
    options: &DeviceAsk,
    surface: &Surface,
    plain: &VirtualOptions,
) -> Result<Opened, TaskError> {
    let (device, unknowns) = device::virtual_surface(options, surface, plain).map_err(failed)?;
    let seed = unknowns.as_ref().map_or(0, |unknowns| unknowns.seed);
    Ok(Opened { rig: Box::new(VirtualRig::new(device, seed)), truth: unknowns.as_ref().map(said) })
}

/// Unknowns in words.
fn said(unknowns: &Perturbation) -> String {
    format!(
        "signal to noise {} dB, gains off by {} %, actuators by {} mm, tension by {} %, {} unknown point masses, other damping",
        unknowns.snr_db,
        unknowns.gain * 100.0,
        unknowns.misplacement * 1e3,
        unknowns.tension * 100.0,
        unknowns.masses.len(),
    )
}

/// All sensors, then the probe, or the force of a hammer.
fn inputs(surface: &Surface, people: &People) -> Vec<String> {
    let last = if people.hammer { FORCE } else { PROBE };
    device::names(surface).into_iter().chain([last.to_owned()]).collect()
}

fn jack(options: &DeviceAsk, surface: &Surface, people: People) -> Result<Opened, TaskError> {
    let device = Jack::open(&device::jack(options, surface, inputs(surface, &people))).map_err(failed)?;
    Ok(Opened { rig: Box::new(HandRig::new(device, people)), truth: None })
}

#[cfg(feature = "cards")]
fn card(options: &DeviceAsk, surface: &Surface, people: People) -> Result<Opened, TaskError> {
    let known = device::card(options, surface, inputs(surface, &people));
    let device = unripple_devices::cards::Card::open(&known).map_err(failed)?;
    Ok(Opened { rig: Box::new(HandRig::new(device, people)), truth: None })
}

/// The error that this build has no sound cards, and how to get one that does.
#[cfg(not(feature = "cards"))]
fn card(options: &DeviceAsk, _: &Surface, _: People) -> Result<Opened, TaskError> {
    let named = options.card.as_ref().or(options.capture_card.as_ref());
    let named = named
        .map_or_else(String::new, |id| format!(" for `{id}` with {} samples a block", options.card_block));
    Err(TaskError::Input(format!(
        "`device` card: expected a build with sound cards{named}, found one without; {}",
        crate::device::HOW_TO_GET_CARDS
    )))
}
