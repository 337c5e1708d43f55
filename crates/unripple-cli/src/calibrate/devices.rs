//! Devices by the names of the command line.

use super::rigs::{HandRig, VirtualRig};
use crate::args::{DeviceName, DeviceOptions};
use crate::error::CliError;
use crate::judge;
use unripple::core::{PROBE, Surface};
use unripple_calibrate::measure::Rig;
use unripple_devices::{DevicesError, Jack, JackOptions, Links, Unknowns, Virtual, VirtualOptions};

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
    let plain = VirtualOptions { accuracy: judge::accuracy(surface), ..VirtualOptions::default() };
    let Some(seed) = options.unknowns else {
        let device = Virtual::new(surface, &plain).map_err(failed)?;
        return Ok(Opened { rig: Box::new(VirtualRig::new(device, 0)), truth: None });
    };
    let unknowns = Unknowns { seed, ..Unknowns::default() };
    let unknowns = Unknowns { snr_db: options.snr_db.unwrap_or(unknowns.snr_db), ..unknowns };
    let truth = unknowns.truth(surface).map_err(failed)?;
    let device = Virtual::of_truth(&truth, &plain).map_err(failed)?;
    let said = format!(
        "signal to noise {} dB, gains off by {} %, actuators by {} mm, tension by {} %, {} stray masses, other damping",
        unknowns.snr_db,
        unknowns.gain * 100.0,
        unknowns.misplacement * 1e3,
        unknowns.tension * 100.0,
        unknowns.masses.len(),
    );
    Ok(Opened { rig: Box::new(VirtualRig::new(device, seed)), truth: Some(said) })
}

fn jack(options: &DeviceOptions, surface: &Surface) -> Result<Opened, CliError> {
    let names: Vec<String> = surface.actuators.iter().map(|actuator| actuator.name.clone()).collect();
    let known = JackOptions {
        server: options.jack_server.clone(),
        inputs: names.iter().cloned().chain([PROBE.to_owned()]).collect(),
        outputs: names,
        links: options.jack_client.clone().map_or(Links::System, Links::Client),
        full_scale: surface.emission.limit,
        freewheel: options.freewheel,
        ..JackOptions::default()
    };
    let device = Jack::open(&known).map_err(failed)?;
    Ok(Opened { rig: Box::new(HandRig::new(device)), truth: None })
}

/// A sound card, whose first channels are the actuators, and their sensors with the probe after them.
#[cfg(feature = "cards")]
fn card(options: &DeviceOptions, surface: &Surface) -> Result<Opened, CliError> {
    use unripple_devices::cards::{Card, CardOptions};
    let names: Vec<String> = surface.actuators.iter().map(|actuator| actuator.name.clone()).collect();
    let known = CardOptions {
        playback: options.card.clone(),
        capture: options.capture_card.clone(),
        inputs: names.iter().cloned().chain([PROBE.to_owned()]).collect(),
        outputs: names,
        rate: surface.emission.rate,
        block: options.card_block,
        full_scale: surface.emission.limit,
        ..CardOptions::default()
    };
    let device = Card::open(&known).map_err(failed)?;
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
