//! A device as an ask gives it, for whoever opens one.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple::core::Surface;
use unripple_devices::{DevicesError, JackOptions, Links, Perturbation, Virtual, VirtualOptions};

/// Advice of a build without sound cards.
#[cfg(not(feature = "cards"))]
pub const HOW_TO_GET_CARDS: &str = "build it with `cargo install --path crates/unripple-cli --features cards` (Debian: \
                                    libasound2-dev, pkg-config), or go through JACK or PipeWire";

/// Kind of device: where drives go and recordings come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DeviceKind {
    /// The surface computed in time, microphone included.
    #[default]
    Virtual,
    /// A JACK server, or PipeWire.
    Jack,
    /// A sound card without a sound server, in a build with the feature `cards`.
    Card,
    /// WAV files: what is to be played is written, what was recorded of it elsewhere is brought back.
    Tape,
}

impl DeviceKind {
    /// Its name in asks and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Virtual => "virtual",
            Self::Jack => "jack",
            Self::Card => "card",
            Self::Tape => "tape",
        }
    }
}

/// The device, and what is virtual about it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeviceAsk {
    /// What plays and listens.
    pub device: DeviceKind,
    /// JACK: another client whose ports `in_NAME` and `out_NAME` are to be joined, instead of the system's.
    pub jack_client: Option<String>,
    /// JACK: name of the server.
    pub jack_server: Option<String>,
    /// JACK: let the server run without a clock, so that nothing is lost however slow the machine. Only for servers without hardware.
    pub freewheel: bool,
    /// Card: the device that plays, as `devices` lists it; by default the system's.
    pub card: Option<String>,
    /// Card: the device that records, of the same card; by default the one that plays.
    pub capture_card: Option<String>,
    /// Card: samples per block.
    pub card_block: usize,
    /// Tape: folder of what is to be played, and of what was recorded of it.
    pub tape: Option<PathBuf>,
    /// Tape: what the channels of a recording hear, in order; by default all actuators, by name, and then the probe. There may be a
    /// `reference`.
    pub tape_inputs: Vec<String>,
    /// JACK, card, tape: drive of a sample at full scale, in A, V or N; by default the surface's limit, and levels are not known.
    pub output_scale: Option<f64>,
    /// Virtual: make the true surface another than the surface file says, by this seed: noise, gains, places, tension, damping, stray
    /// masses.
    pub unknowns: Option<u64>,
    /// Virtual, with unknowns: signal to noise, in dB.
    pub snr_db: Option<f64>,
}

impl Default for DeviceAsk {
    fn default() -> Self {
        Self {
            device: DeviceKind::Virtual,
            jack_client: None,
            jack_server: None,
            freewheel: false,
            card: None,
            capture_card: None,
            card_block: 256,
            tape: None,
            tape_inputs: Vec::new(),
            output_scale: None,
            unknowns: None,
            snr_db: None,
        }
    }
}

impl DeviceAsk {
    /// Whether the device has a clock of its own that nobody can stop.
    pub fn is_real(&self) -> bool {
        self.device != DeviceKind::Virtual && !self.freewheel
    }
}

/// A virtual surface, and what is true of it beyond its file, if anything.
///
/// # Errors
/// Those of [`Virtual`] and [`Perturbation::truth`].
pub fn virtual_surface(
    options: &DeviceAsk,
    surface: &Surface,
    plain: &VirtualOptions,
) -> Result<(Virtual, Option<Perturbation>), DevicesError> {
    let Some(seed) = options.unknowns else {
        return Ok((Virtual::new(surface, plain)?, None));
    };
    let usual = Perturbation { seed, ..Perturbation::default() };
    let unknowns = Perturbation { snr_db: options.snr_db.unwrap_or(usual.snr_db), ..usual };
    let device = Virtual::of_truth(&unknowns.truth(surface)?, plain)?;
    Ok((device, Some(unknowns)))
}

/// Names of the actuators, which are those of their channels.
pub fn names(surface: &Surface) -> Vec<String> {
    surface.actuators.iter().map(|actuator| actuator.name.clone()).collect()
}

/// A sound server that plays all actuators and hears some channels.
pub fn jack(options: &DeviceAsk, surface: &Surface, inputs: Vec<String>) -> JackOptions {
    JackOptions {
        server: options.jack_server.clone(),
        inputs,
        outputs: names(surface),
        links: options.jack_client.clone().map_or(Links::System, Links::Client),
        full_scale: options.output_scale.unwrap_or(surface.emission.limit),
        freewheel: options.freewheel,
        ..JackOptions::default()
    }
}

/// A sound card, whose first channels are the actuators, and those that it hears.
#[cfg(feature = "cards")]
pub fn card(
    options: &DeviceAsk,
    surface: &Surface,
    inputs: Vec<String>,
) -> unripple_devices::cards::CardOptions {
    unripple_devices::cards::CardOptions {
        playback: options.card.clone(),
        capture: options.capture_card.clone(),
        inputs,
        outputs: names(surface),
        rate: surface.emission.rate,
        block: options.card_block,
        full_scale: options.output_scale.unwrap_or(surface.emission.limit),
        ..Default::default()
    }
}
