//! Options of a device in a request, and the options of each kind of device made from them.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple::core::Surface;
use unripple_devices::{DevicesError, JackOptions, Links, Perturbation, Virtual, VirtualOptions};

/// Advice on how to build the program with sound cards, for error messages of a build without them.
#[cfg(not(feature = "cards"))]
pub const HOW_TO_GET_CARDS: &str = "build it with `cargo install --path crates/unripple-cli --features cards` (Debian: \
                                    libasound2-dev, pkg-config), or go through JACK or PipeWire";

/// Kind of device: where drives go and recordings come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DeviceKind {
    /// A simulation of the surface in the time domain, with its sensors and a probe.
    #[default]
    Virtual,
    /// A JACK server, or PipeWire.
    Jack,
    /// A sound card without a sound server, in a build with the feature `cards`.
    Card,
    /// WAV files: the signal to play is written to a file, and recordings of it made elsewhere are read.
    Tape,
}

impl DeviceKind {
    /// Name of the kind of device in requests and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Virtual => "virtual",
            Self::Jack => "jack",
            Self::Card => "card",
            Self::Tape => "tape",
        }
    }
}

/// Options of a device: its kind, and options of each kind, which other kinds ignore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeviceAsk {
    /// Kind of the device that plays and records.
    pub device: DeviceKind,
    /// JACK: client whose ports `in_NAME` and `out_NAME` are connected, instead of the system's ports.
    pub jack_client: Option<String>,
    /// JACK: name of the server.
    pub jack_server: Option<String>,
    /// JACK: let the server run without a clock (freewheel), so that no block is lost on a slow machine. Only for servers without hardware.
    pub freewheel: bool,
    /// Card: the playback device, as `devices` lists it; by default the system's.
    pub card: Option<String>,
    /// Card: the recording device, of the same card; by default the playback device.
    pub capture_card: Option<String>,
    /// Card: number of samples per block.
    pub card_block: usize,
    /// Tape: folder for the file to play and for the recordings of it.
    pub tape: Option<PathBuf>,
    /// Tape: what is connected to each channel of a recording, in order; by default the sensors of all actuators, by name, then the probe.
    /// May include `reference`.
    pub tape_inputs: Vec<String>,
    /// JACK, card, tape: drive of an actuator when a sample is at full scale, in A, V or N; by default the surface's limit, and absolute
    /// levels are unknown.
    pub output_scale: Option<f64>,
    /// Virtual: seed by which the simulated surface differs at random from its file, in noise, gains, places, tension, damping and stray
    /// masses; by default it does not differ.
    pub unknowns: Option<u64>,
    /// Virtual, with `unknowns`: signal-to-noise ratio of the simulated sensors, in dB.
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
    /// Whether the device runs in real time, by its own clock. The virtual surface does not, nor does a
    /// JACK server with `freewheel`.
    pub fn is_real(&self) -> bool {
        self.device != DeviceKind::Virtual && !self.freewheel
    }
}

/// Opens a virtual surface. If the options set `unknowns`, the simulated surface is perturbed, and the
/// perturbation is returned as well.
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

/// Names of the actuators, which are also the names of their channels.
pub fn names(surface: &Surface) -> Vec<String> {
    surface.actuators.iter().map(|actuator| actuator.name.clone()).collect()
}

/// Options of a JACK client with an output for each actuator and the input channels `inputs`.
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

/// Options of a sound card whose first output channels are the actuators, with the input channels `inputs`.
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
