//! Options of `unripple calibrate`, and of devices.

use super::{DeviceName, WayName};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::DeviceAsk;

/// The device, and what is virtual about it.
#[derive(Clone, Debug, Args)]
pub struct DeviceOptions {
    /// What plays and listens.
    #[arg(long, value_enum, default_value_t)]
    pub device: DeviceName,
    /// JACK: another client whose ports `in_NAME` and `out_NAME` are to be joined, instead of the system's.
    #[arg(long, value_name = "CLIENT")]
    pub jack_client: Option<String>,
    /// JACK: name of the server.
    #[arg(long, value_name = "SERVER")]
    pub jack_server: Option<String>,
    /// JACK: let the server run without a clock, so that nothing is lost however slow the machine. Only for servers
    /// without hardware.
    #[arg(long)]
    pub freewheel: bool,
    /// Card: the device that plays, as `unripple devices` lists it; by default the system's.
    #[arg(long, value_name = "ID")]
    pub card: Option<String>,
    /// Card: the device that records, of the same card; by default the one that plays.
    #[arg(long, value_name = "ID")]
    pub capture_card: Option<String>,
    /// Card: samples per block.
    #[arg(long, value_name = "N", default_value_t = 256)]
    pub card_block: usize,
    /// Tape: folder of what is to be played, and of what was recorded of it.
    #[arg(long, value_name = "DIR")]
    pub tape: Option<PathBuf>,
    /// Tape: what the channels of a recording hear, in order; by default all actuators, by name, and then the probe. There may
    /// be a `reference`.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub tape_inputs: Vec<String>,
    /// JACK, card, tape: drive of a sample at full scale, in A, V or N; by default the surface's limit, and levels are not known.
    #[arg(long, value_name = "DRIVE", allow_negative_numbers = true)]
    pub output_scale: Option<f64>,
    /// Virtual: make the true surface another than SURFACE says, by this seed: noise, gains, places, tension, damping, stray
    /// masses.
    #[arg(long, value_name = "SEED")]
    pub unknowns: Option<u64>,
    /// Virtual, with --unknowns: signal to noise, in dB.
    #[arg(long, value_name = "DB", requires = "unknowns", allow_negative_numbers = true)]
    pub snr_db: Option<f64>,
}

impl DeviceOptions {
    /// The same in SI units.
    pub fn ask(&self) -> DeviceAsk {
        DeviceAsk {
            device: self.device.kind(),
            jack_client: self.jack_client.clone(),
            jack_server: self.jack_server.clone(),
            freewheel: self.freewheel,
            card: self.card.clone(),
            capture_card: self.capture_card.clone(),
            card_block: self.card_block,
            tape: self.tape.clone(),
            tape_inputs: self.tape_inputs.clone(),
            output_scale: self.output_scale,
            unknowns: self.unknowns,
            snr_db: self.snr_db,
        }
    }
}

/// Options of `calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateOptions {
    /// A surface file, or the name of a built-in surface: what is known of the surface beforehand.
    pub surface: String,
    /// What plays and listens.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// Distance of the points of a square grid, in mm.
    #[arg(long, value_name = "P", allow_negative_numbers = true)]
    pub grid_mm: Option<f64>,
    /// A point in mm. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// How points are measured.
    #[arg(long, value_enum, default_value_t)]
    pub by: WayName,
    /// Recordings of each point, averaged; taps of each point.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub repeats: usize,
    /// Length of an actuator's sweep, in ms; by default 500, or more as long as the surface rings.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub sweep_ms: Option<f64>,
    /// Length of each response that is kept, in ms; by default 100, or more as long as the surface rings.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub response_ms: Option<f64>,
    /// Drive, as a share of the surface's limit.
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, allow_negative_numbers = true)]
    pub level: f64,
    /// Name of a channel where it is not that of the actuator, sensor, probe or reference. Repeatable.
    #[arg(long, value_name = "NAME=CHANNEL")]
    pub wire: Vec<String>,
    /// What an input at full scale stands for: m/s for the probe, the sensors' unit for actuators; below 0 where it is reversed. Without a
    /// name it is that of all inputs. Repeatable. Without it levels are not known.
    #[arg(long, value_name = "[NAME=]SCALE", allow_hyphen_values = true)]
    pub input_scale: Vec<String>,
    /// An actuator that is to be left out, since it is dead. Repeatable.
    #[arg(long, value_name = "NAME")]
    pub without: Vec<String>,
    /// Time by which the probe hears later than sensors do, in ms: a vibrometer's decoder; by default it is found.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub probe_delay_ms: Option<f64>,
    /// Hold nothing against a model: for a surface that no model fits, such as a whole phone or a sheet with ribs.
    #[arg(long)]
    pub no_model: bool,
    /// Tape: bring recordings of another rate to that of the surface.
    #[arg(long)]
    pub resample: bool,
    /// Listen to levels only: a short take that says what is too loud or too quiet, and what to do.
    #[arg(long)]
    pub check_levels: bool,
    /// Go on although the wiring test finds a fault.
    #[arg(long)]
    pub any_wiring: bool,
    /// Folder for a figure, SVG and PNG: signal to noise and coherence over frequency, and which point is bad in which band. An earlier
    /// run's folder is replaced whole, unless something else is in it.
    #[arg(long, value_name = "DIR", conflicts_with = "check_levels")]
    pub figure: Option<PathBuf>,
    /// The library: a new folder, or one that a run like this one was filling.
    #[arg(short, long, value_name = "LIBRARY")]
    pub output: PathBuf,
}
