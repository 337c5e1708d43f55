//! Options of `unripple calibrate`, and of devices.

use super::{DeviceName, WayName, examples, heading};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::DeviceAsk;

/// Options of the device: its kind, and options for each kind, which are ignored for the other kinds.
#[derive(Clone, Debug, Args)]
pub struct DeviceOptions {
    /// The device that plays and records.
    #[arg(long, value_enum, default_value_t, help_heading = heading::DEVICE)]
    pub device: DeviceName,
    /// JACK: connect to the ports `in_NAME` and `out_NAME` of this client instead of the system's ports.
    #[arg(long, value_name = "CLIENT", help_heading = heading::JACK)]
    pub jack_client: Option<String>,
    /// JACK: name of the server.
    #[arg(long, value_name = "SERVER", help_heading = heading::JACK)]
    pub jack_server: Option<String>,
    /// JACK: let the server run without a clock (freewheel), so that no block is lost on a slow machine. Only for servers without
    /// hardware.
    #[arg(long, help_heading = heading::JACK)]
    pub freewheel: bool,
    /// Card: the playback device, as `unripple devices` lists it; by default the system's default device.
    #[arg(long, value_name = "ID", help_heading = heading::CARD)]
    pub card: Option<String>,
    /// Card: the recording device, of the same card; by default the playback device.
    #[arg(long, value_name = "ID", help_heading = heading::CARD)]
    pub capture_card: Option<String>,
    /// Card: samples per block.
    #[arg(long, value_name = "N", default_value_t = 256, help_heading = heading::CARD)]
    pub card_block: usize,
    /// For recordings made elsewhere (device `tape`): folder to which the file to play is written, and from which its recordings are read.
    #[arg(long, value_name = "DIR", help_heading = heading::TAPE)]
    pub tape: Option<PathBuf>,
    /// Tape: what is connected to each channel of a recording, in order; by default the sensors of all actuators, by name, then
    /// the probe. May include `reference`.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', help_heading = heading::TAPE)]
    pub tape_inputs: Vec<String>,
    /// JACK, card, tape: drive of an actuator, in A, V or N, when a sample is at full scale. By default the surface's drive limit
    /// is assumed, and absolute levels are unknown.
    #[arg(long, value_name = "DRIVE", allow_negative_numbers = true, help_heading = heading::DEVICE)]
    pub output_scale: Option<f64>,
    /// Virtual: simulate a surface that differs randomly from SURFACE, by this seed, in noise, gains, places, tension, damping
    /// and unknown point masses.
    #[arg(long, value_name = "SEED", help_heading = heading::VIRTUAL)]
    pub unknowns: Option<u64>,
    /// Virtual, with --unknowns: signal-to-noise ratio, in dB.
    #[arg(long, value_name = "DB", requires = "unknowns", allow_negative_numbers = true, help_heading = heading::VIRTUAL)]
    pub snr_db: Option<f64>,
}

impl DeviceOptions {
    /// Converts the options to a [`DeviceAsk`], in SI units.
    pub fn ask(&self) -> DeviceAsk {
        DeviceAsk {
            device: self.device.into(),
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
#[command(after_help = examples::CALIBRATE)]
pub struct CalibrateOptions {
    /// A surface file, or the name of a built-in surface: what is known of the surface before the measurement.
    pub surface: String,
    /// The device that plays and records.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// Spacing of a square grid of points to measure, in mm.
    #[arg(long, value_name = "P", allow_negative_numbers = true, help_heading = heading::POINTS)]
    pub grid_mm: Option<f64>,
    /// A point to measure, in mm. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::POINTS)]
    pub at: Vec<String>,
    /// How points are measured.
    #[arg(long, value_enum, default_value_t, help_heading = heading::POINTS)]
    pub by: WayName,
    /// Tape, by taps or hammer: table (CSV) with the columns file, x_mm and y_mm, which says where each file was recorded; by default the
    /// files are point-001.wav and so on, in the order of the points.
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["grid_mm", "at"], help_heading = heading::TAPE)]
    pub table: Option<PathBuf>,
    /// Number of recordings of each point, which are averaged, or of taps at each point: 1 to 99.
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = heading::POINTS)]
    pub repeats: usize,
    /// Length of an actuator's sweep, in ms; by default 500, or longer for a surface with a long decay time.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::SWEEPS)]
    pub sweep_ms: Option<f64>,
    /// Length of each stored response, in ms, at most 60 000; by default 100, or longer for a surface with a long decay time.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::SWEEPS)]
    pub response_ms: Option<f64>,
    /// Level of the sweeps, as a fraction of the surface's drive limit.
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, allow_negative_numbers = true, help_heading = heading::SWEEPS)]
    pub level: f64,
    /// Use the channel CHANNEL for the actuator, sensor, probe or reference called NAME, if the channel has another name.
    /// Repeatable.
    #[arg(long, value_name = "NAME=CHANNEL", help_heading = heading::WIRING)]
    pub wire: Vec<String>,
    /// Value of an input at full scale: in m/s for the probe, in N for the force of a hammer, in the sensor's unit for an actuator;
    /// negative if the input is reversed. Without a name it applies to all inputs. Repeatable. Without this option absolute levels
    /// are unknown, and nothing is measured by a hammer.
    #[arg(long, value_name = "[NAME=]SCALE", allow_hyphen_values = true, help_heading = heading::WIRING)]
    pub input_scale: Vec<String>,
    /// Do not use the actuator of this name, for example because it is dead. Repeatable.
    #[arg(long, value_name = "NAME", help_heading = heading::WIRING)]
    pub without: Vec<String>,
    /// Delay of the probe relative to the sensors, in ms, such as that of a vibrometer's decoder; by default it is estimated.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::WIRING)]
    pub probe_delay_ms: Option<f64>,
    /// Compare nothing with a model: for a surface that the model cannot describe, such as a whole phone or a sheet with ribs.
    #[arg(long, help_heading = heading::MODEL)]
    pub no_model: bool,
    /// Tape: resample recordings whose sample rate is not that of the surface.
    #[arg(long, help_heading = heading::WIRING)]
    pub resample: bool,
    /// Only check levels: one short recording shows what is too loud or too quiet, and what to do about it.
    #[arg(long, help_heading = heading::SWEEPS)]
    pub check_levels: bool,
    /// Continue although the wiring test finds a fault.
    #[arg(long, help_heading = heading::WIRING)]
    pub any_wiring: bool,
    /// Folder for a picture, SVG and PNG: signal-to-noise ratio and coherence over frequency, and which point is bad in which
    /// band. An existing folder is replaced only if it holds nothing but the unchanged files of an earlier run.
    #[arg(long, value_name = "DIR", conflicts_with = "check_levels", help_heading = heading::RESULTS)]
    pub figure: Option<PathBuf>,
    /// The library: a new folder, or that of an unfinished run with the same options.
    #[arg(short, long, value_name = "LIBRARY", help_heading = heading::RESULTS)]
    pub output: PathBuf,
}
