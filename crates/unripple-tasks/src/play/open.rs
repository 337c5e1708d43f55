//! Opens the device through which a surface is played.

use super::ask::Ask;
use crate::{DeviceAsk, DeviceKind, TaskError, device, judge};
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple::core::{Device, ModalResponses, Surface};
use unripple::physics::{Medium, StepperOptions};
use unripple_calibrate::{Tracker, Tracking, Warp};
use unripple_devices::{DevicesError, Feeler, Jack, JackOptions, VirtualOptions};
use unripple_live::Recovering;

/// Largest number of fingers that a virtual surface computes at once: ten of two hands, and others that are
/// being lifted. Each costs a coordinate in every step.
const FINGERS: usize = 24;

/// Number of fingers whose sensation is computed: the ten of two hands. Each costs one place at which the
/// motion is recorded.
const FELT: usize = 10;

/// Number of attempts to open a lost sound server again. At four seconds each that is more than an hour.
const TRIES: u32 = 1000;

/// Number of blocks by which the drive is ahead on a device without a process callback: the fewest that
/// such a device takes.
const LEAD: usize = 2;

/// Share of the sensors' signals that the model may leave unexplained: after a finger has left, the sheet
/// still rings a little as it did under the finger.
const MODEL: f64 = 0.02;

/// Period of the drift of tension that can be requested, and the spacing of the points at which it is
/// tabulated, both in s.
const MINUTE: f64 = 60.0;
const KNOT: f64 = 0.1;

/// Duration of the tabulated drift, in s. After it the tension stays constant.
const LONGEST: f64 = 3600.0;

/// An open device, with the simulation of what fingers feel and its latency.
pub(super) struct Opened {
    /// The device that plays.
    pub device: Box<dyn Device>,
    /// Computes what fingers feel on a virtual surface; `None` for a real device.
    pub feeler: Option<Feeler>,
    /// Latency from drive to input, in samples.
    pub latency: usize,
}

/// Opens the device that a request names.
pub(super) fn open(ask: &Ask, surface: &Surface) -> Result<Opened, TaskError> {
    match ask.device.device {
        DeviceKind::Virtual => virtual_surface(ask, surface),
        DeviceKind::Jack => jack(&ask.device, surface, heard(ask, surface)),
        DeviceKind::Card => card(&ask.device, surface, heard(ask, surface)),
        DeviceKind::Tape => Err(TaskError::Input(
            "`device` tape: expected a device that plays while touches come, found files (`keep_drive` writes one)".into(),
        )),
    }
}

fn virtual_surface(ask: &Ask, surface: &Surface) -> Result<Opened, TaskError> {
    let stepper = StepperOptions { max_fingers: FINGERS, ..StepperOptions::default() };
    let mut plain = VirtualOptions {
        block: ask.block,
        stepper,
        accuracy: judge::accuracy(surface),
        real_time: ask.clock().is_some(),
        ..VirtualOptions::default()
    };
    plain.faults.tension = ask.drift.map_or_else(Vec::new, drift);
    let (device, _) = device::virtual_surface(&ask.device, surface, &plain).map_err(TaskError::input)?;
    let feeler = Feeler::new(device.handle(), surface, FELT)?;
    Ok(Opened { device: Box::new(device), feeler: Some(feeler), latency: 0 })
}

/// Table of time (s) and of the tension relative to its nominal value, which varies as a sine with
/// amplitude `share` and a period of a minute.
fn drift(share: f64) -> Vec<(f64, f64)> {
    let knots = (LONGEST / KNOT) as usize;
    let at = |i: usize| i as f64 * KNOT;
    (0..=knots).map(|i| (at(i), 1.0 + share * (TAU * at(i) / MINUTE).sin())).collect()
}

/// Function that opens the device of a surface, or returns the reason why it cannot be opened.
pub type Opener = Arc<dyn Fn(&Surface) -> Result<Box<dyn Device>, String> + Send + Sync>;

/// Returns a function that opens the device that the options name. If `hears`, JACK and cards have an input
/// for each actuator's sensor, else no inputs. A virtual surface runs in real time. Files (tape) are
/// refused.
pub fn opener(options: &DeviceAsk, hears: bool) -> Opener {
    let options = options.clone();
    Arc::new(move |surface| {
        let heard = || if hears { device::names(surface) } else { Vec::new() };
        let opened = match options.device {
            DeviceKind::Virtual => truth(&options, surface),
            DeviceKind::Jack => jack(&options, surface, heard()).map(|opened| opened.device),
            DeviceKind::Card => card(&options, surface, heard()).map(|opened| opened.device),
            DeviceKind::Tape => {
                Err(TaskError::Input("expected a device that plays while touches come, found files".into()))
            }
        };
        opened.map_err(|error| error.to_string())
    })
}

/// Latency in samples from drive to input on a device that [`opener`] opens, for blocks of `block` samples; 0 on a
/// virtual surface.
pub fn latency(options: &DeviceAsk, block: usize) -> usize {
    if options.device == DeviceKind::Virtual { 0 } else { (LEAD + 1) * block }
}

fn truth(options: &DeviceAsk, surface: &Surface) -> Result<Box<dyn Device>, TaskError> {
    let plain =
        VirtualOptions { accuracy: judge::accuracy(surface), real_time: true, ..VirtualOptions::default() };
    let (device, _) = device::virtual_surface(options, surface, &plain).map_err(TaskError::input)?;
    Ok(Box::new(device))
}

fn jack(options: &DeviceAsk, surface: &Surface, heard: Vec<String>) -> Result<Opened, TaskError> {
    let usual = device::jack(options, surface, heard);
    let mut known = JackOptions { lead: LEAD, ..usual };
    recovering(move || {
        let device = Jack::open(&known)?;
        // A server may come back with another period; whoever exchanges blocks goes on with those of the first.
        known.block = Some(device.layout().block);
        Ok(Box::new(device))
    })
}

#[cfg(feature = "cards")]
fn card(options: &DeviceAsk, surface: &Surface, heard: Vec<String>) -> Result<Opened, TaskError> {
    use unripple_devices::cards::{Card, CardOptions};
    let usual = device::card(options, surface, heard);
    let known = CardOptions { strict: false, ..usual };
    recovering(move || Ok(Box::new(Card::open(&known)?)))
}

#[cfg(not(feature = "cards"))]
fn card(_: &DeviceAsk, _: &Surface, _: Vec<String>) -> Result<Opened, TaskError> {
    let text = "`device` card: expected a build with sound cards, found one without; ";
    Err(TaskError::Input(format!("{text}{}", crate::device::HOW_TO_GET_CARDS)))
}

/// Names of the sensors whose signals are used: those of all actuators if tension is to be followed, else
/// none.
fn heard(ask: &Ask, surface: &Surface) -> Vec<String> {
    if ask.follow_tension { device::names(surface) } else { Vec::new() }
}

/// A device that is opened again when it is lost. An error at the first opening is returned at once.
fn recovering(
    mut open: impl FnMut() -> Result<Box<dyn Device>, DevicesError> + Send + 'static,
) -> Result<Opened, TaskError> {
    let first = open().map_err(TaskError::work)?;
    let block = first.layout().block;
    let latency = match first.status().server {
        // What is played in a cycle comes back in the next at the earliest.
        Some(server) => ((server.playback + server.capture) as usize).max(block),
        None => (LEAD + 1) * block,
    };
    let mut first = Some(first);
    let again = move || match first.take() {
        Some(device) => Ok(device),
        None => open().map_err(|error| error.to_string()),
    };
    let device = Recovering::open(Box::new(again), TRIES).map_err(TaskError::work)?;
    Ok(Opened { device: Box::new(device), feeler: None, latency })
}

/// Tracker of the tension of a surface whose modes are known.
pub(super) fn tracker(surface: &Surface, modal: &ModalResponses) -> Result<Tracker, TaskError> {
    let warp = Warp::new(&Medium::of(&surface.sheet));
    let shares: Vec<f64> = modal.poles.iter().map(|pole| warp.bending_share(pole.omega)).collect();
    Ok(Tracker::of_surface(surface, modal, &shares, &Tracking { model: MODEL, ..Tracking::default() })?)
}
