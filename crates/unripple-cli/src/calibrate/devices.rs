//! Devices by the names of the command line.

use super::rigs::{HandRig, VirtualRig};
use crate::args::{DeviceName, DeviceOptions};
use crate::error::CliError;
use crate::{judge, open};
use unripple::core::{PROBE, Surface};
use unripple_calibrate::measure::Rig;
use unripple_devices::{DevicesError, Jack, Unknowns, VirtualOptions};

/// An open device with whoever moves its probe.
pub struct Opened {
    pub rig: Box<dyn Rig>,
    /// What is true of a virtual surface and was not told.
    pub truth: Option<String>,
}

/// A failure of the device, or a device that does not fit.
fn failed(error: DevicesError) -> CliError {
    match error {
        DevicesError::Jack { .. } | DevicesError::Card { .. } | DevicesError::Device(_) => {
            CliError::work(error)
        }
        error => CliError::input(error),
    }
}

pub fn open(options: &DeviceOptions, surface: &Surface) -> Result<Opened, CliError> {
    match options.device {
        DeviceName::Virtual => virtual_surface(options, surface),
        DeviceName::Jack => jack(options, surface),
        DeviceName::Card => card(options, surface),
        DeviceName::Tape => Err(CliError::Input(
            "--device tape: expected a device that plays and listens at once, found files".into(),
        )),
    }
}

fn virtual_surface(options: &DeviceOptions, surface: &Surface) -> Result<Opened, CliError> {
    let plain = VirtualOptions::to_be_measured(surface).map_err(failed)?;
    let plain = VirtualOptions { accuracy: judge::accuracy(surface), ..plain };
    let (device, unknowns) = open::virtual_surface(options, surface, &plain).map_err(failed)?;
    let seed = unknowns.as_ref().map_or(0, |unknowns| unknowns.seed);
    Ok(Opened { rig: Box::new(VirtualRig::new(device, seed)), truth: unknowns.as_ref().map(said) })
}

/// Unknowns in words.
fn said(unknowns: &Unknowns) -> String {
    format!(
        "signal to noise {} dB, gains off by {} %, actuators by {} mm, tension by {} %, {} stray masses, other damping",
        unknowns.snr_db,
        unknowns.gain * 100.0,
        unknowns.misplacement * 1e3,
        unknowns.tension * 100.0,
        unknowns.masses.len(),
    )
}

/// All sensors, then the probe.
fn inputs(surface: &Surface) -> Vec<String> {
    open::names(surface).into_iter().chain([PROBE.to_owned()]).collect()
}

fn jack(options: &DeviceOptions, surface: &Surface) -> Result<Opened, CliError> {
    let device = Jack::open(&open::jack(options, surface, inputs(surface))).map_err(failed)?;
    Ok(Opened { rig: Box::new(HandRig::new(device)), truth: None })
}

#[cfg(feature = "cards")]
fn card(options: &DeviceOptions, surface: &Surface) -> Result<Opened, CliError> {
    let known = open::card(options, surface, inputs(surface));
    let device = unripple_devices::cards::Card::open(&known).map_err(failed)?;
    Ok(Opened { rig: Box::new(HandRig::new(device)), truth: None })
}

/// Says how to get a program that knows cards.
#[cfg(not(feature = "cards"))]
fn card(options: &DeviceOptions, _surface: &Surface) -> Result<Opened, CliError> {
    let named = options.card.as_ref().or(options.capture_card.as_ref());
    let named = named
        .map_or_else(String::new, |id| format!(" for `{id}` with {} samples a block", options.card_block));
    Err(CliError::Input(format!(
        "--device card: expected a build with sound cards{named}, found one without; {}",
        crate::devices::HOW_TO_GET_CARDS
    )))
}

/// Channels by other names: `a1=system:playback_3`.
pub fn named(wires: &[String]) -> Result<Vec<(String, String)>, CliError> {
    let split = |text: &String| match text.split_once('=') {
        Some((name, channel)) if !name.is_empty() && !channel.is_empty() => {
            Ok((name.to_owned(), channel.to_owned()))
        }
        _ => Err(CliError::Input(format!("--wire {text}: expected NAME=CHANNEL, found `{text}`"))),
    };
    wires.iter().map(split).collect()
}
