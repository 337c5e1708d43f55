//! What can be typed. Lengths in mm, times in ms.

mod calibrate;
mod export;
mod fit;
mod names;
mod play;
mod view;

pub use calibrate::{CalibrateOptions, DeviceOptions};
use clap::{Args, Parser, Subcommand};
pub use export::ExportOptions;
pub use fit::FitOptions;
pub use names::{BetweenName, DeviceName, LossName, MethodName, WayName};
pub use play::{DoctorOptions, PlayOptions};
use std::path::PathBuf;
pub use view::ViewOptions;

/// Waves that meet under a fingertip: design, simulate and focus a reverberant touch surface.
///
/// SURFACE is a TOML file or the name of a built-in surface, such as hudin-2012. LIBRARY is a folder of responses.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true)]
pub struct Arguments {
    /// Print one JSON object (SI units) on standard output, everything else on standard error.
    #[arg(long, global = true)]
    pub json: bool,
    /// A key of SURFACE's file set to another value, as in sheet.tension_n_per_m=220 or actuator[0].at_mm=[12,31]; without a value the key is
    /// taken away. Repeatable.
    #[arg(long, global = true, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Celerities, modes, window, predicted contrast, spot, power at the finger.
    Design(DesignOptions),
    /// Modal analysis: frequencies and decay times.
    Modes(ModesOptions),
    /// Responses from the model, as a library.
    Respond(RespondOptions),
    /// A drive that focuses on points or shapes, with its report and figures.
    Focus(FocusOptions),
    /// Every method on the same targets: one table, one figure.
    Compare(CompareOptions),
    /// What any drive does to a surface.
    Field(FieldOptions),
    /// Responses measured through a device, as a library that `focus` and `field` take in place of a surface.
    Calibrate(CalibrateOptions),
    /// A library of responses as WAV files or as one SOFA file.
    Export(ExportOptions),
    /// A surface that answers fingers, live: touches in, waves out.
    Play(PlayOptions),
    /// The surface in a browser: touched, read, designed, compared.
    View(ViewOptions),
    /// The model fitted to what actuators hear of each other, and its responses anywhere.
    Fit(FitOptions),
    /// All faults of a surface file.
    Check(CheckOptions),
    /// What drives can be played through: virtual surface, files, sound server, cards.
    Devices(DevicesOptions),
    /// Each stage between a touch and what is felt, checked in turn: why nothing may be felt.
    Doctor(DoctorOptions),
    /// The paper's table and figures beside ours, as one page.
    Reproduce(ReproduceOptions),
}

/// Options of `check`.
#[derive(Debug, Args)]
pub struct CheckOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
}

/// Options of `devices`.
#[derive(Debug, Args)]
pub struct DevicesOptions {
    /// Name of the JACK server to look at; by default the default one.
    #[arg(long, value_name = "NAME")]
    pub server: Option<String>,
}

/// Options of `design`.
#[derive(Debug, Args)]
pub struct DesignOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
}

/// Options of `modes`.
#[derive(Debug, Args)]
pub struct ModesOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
    /// Highest frequency, in Hz; by default the top of the surface's band.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    pub max_hz: Option<f64>,
    /// Relative accuracy of the frequencies.
    #[arg(long, value_name = "FRACTION", default_value_t = 1e-6, allow_negative_numbers = true)]
    pub accuracy: f64,
}

/// Options of `respond`.
#[derive(Debug, Args)]
pub struct RespondOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
    /// Distance between points, in mm: they lie at its multiples, those near the rim left out.
    #[arg(long, value_name = "P", allow_negative_numbers = true)]
    pub grid_mm: f64,
    /// Length of the responses in ms; by default twice the window that `design` recommends.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub length_ms: Option<f64>,
    /// Folder of the library. One of the same plan is taken up where it was left.
    #[arg(short, long, value_name = "LIBRARY")]
    pub output: PathBuf,
}

/// Where to focus, and how strongly.
#[derive(Debug, Default, Args)]
pub struct TargetOptions {
    /// A point in mm, with an optional gain and repetition rate in Hz. Repeatable.
    #[arg(long, value_name = "X,Y[,GAIN[,HZ]]", allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// A shape in mm: an SVG file, triangle:X,Y,SIZE or circle:X,Y,R. Repeatable.
    #[arg(long, value_name = "SHAPE")]
    pub shape: Vec<String>,
    /// Peak displacement wanted at the first target, in µm; by default nothing moves by more than about half the sheet's thickness.
    #[arg(long, value_name = "UM", allow_negative_numbers = true)]
    pub peak_um: Option<f64>,
    /// Level wanted at the first target as felt, in dB above the threshold of touch.
    #[arg(long, value_name = "L", allow_negative_numbers = true, conflicts_with = "peak_um")]
    pub felt_db: Option<f64>,
    /// As strong as the drive limit allows, though linear theory may not hold there.
    #[arg(long, conflicts_with_all = ["peak_um", "felt_db"])]
    pub full_limit: bool,
    /// A waveform at a point in mm: sine:HZ,MS, burst:HZ,CYCLES, click:MS or a WAV file, with its peak in µm. Repeatable.
    #[arg(long, value_name = "X,Y,WHAT[,UM]", allow_hyphen_values = true)]
    pub waveform: Vec<String>,
    /// A point in mm that is to be still while waveforms are played. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub silent: Vec<String>,
    /// A path in mm that a focus moves along: line:X1,Y1,X2,Y2, a shape as above, or an SVG file.
    #[arg(long, value_name = "PATH")]
    pub path: Option<String>,
    /// How fast it moves, in mm/s.
    #[arg(long, value_name = "V", allow_negative_numbers = true)]
    pub speed_mm_s: Option<f64>,
    /// Velocity of its pulses, in mm/s; 10 by default.
    #[arg(long, value_name = "V", allow_negative_numbers = true)]
    pub level_mm_s: Option<f64>,
}

/// Options of `focus`.
#[derive(Debug, Args)]
pub struct FocusOptions {
    /// A surface file, the name of a built-in surface, or a library of responses.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    #[command(flatten)]
    pub targets: TargetOptions,
    /// How to focus.
    #[arg(long, value_enum, default_value_t = MethodName::TimeReversal)]
    pub method: MethodName,
    /// How far from time reversal (0) to the method's own limit (1).
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub strength: Option<f64>,
    /// For `limited`: the level at the limit, from that of the unlimited drive (0) to that of one-bit (1).
    #[arg(long, value_name = "SHARE", default_value_t = 0.5, allow_negative_numbers = true)]
    pub push: f64,
    /// Largest rms of all actuators together, in the drive's unit.
    #[arg(long, value_name = "RMS", allow_negative_numbers = true)]
    pub total_rms: Option<f64>,
    /// For `robust`: the stretch of frequencies to be borne up and down, in per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.5, allow_negative_numbers = true)]
    pub spread_percent: f64,
    /// For `felt`: from the mean of what is felt elsewhere (0) to its worst spot (1).
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub worst: Option<f64>,
    /// For `felt`: weight of the drive's energy.
    #[arg(long, value_name = "WEIGHT", allow_negative_numbers = true)]
    pub economy: Option<f64>,
    /// For `inverse`: bring displacements to zero as well.
    #[arg(long)]
    pub rest: bool,
    /// Window T in ms; by default the one that `design` recommends.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub window_ms: Option<f64>,
    /// What stands for a target between the points of a library.
    #[arg(long, value_enum, default_value_t)]
    pub between: BetweenName,
    /// Make up for losses in what is played back.
    #[arg(long, value_enum, default_value_t = LossName::None)]
    pub losses: LossName,
    /// Length of a repeated drive in ms; by default long enough to be steady.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub duration_ms: Option<f64>,
    /// A finger resting at X,Y in mm while the drive is judged: the drive is what it would be without. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub finger: Vec<String>,
    /// Make the drive for the surface under those fingers.
    #[arg(long)]
    pub finger_aware: bool,
    /// For `robust`: bear a tension off by this many per cent, up and down.
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true)]
    pub bear_tension_percent: Option<f64>,
    /// For `robust`: bear a finger at X,Y in mm that may be there or not. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub bear_finger: Vec<String>,
    /// Judge the drive on another surface than the one, or than the library, it was computed for.
    #[arg(long, value_name = "SURFACE")]
    pub on: Option<String>,
    /// Judge on modes up to this frequency, in Hz; by default those of the band.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    pub judge_hz: Option<f64>,
    /// Folder for drive.wav, report.json, report.md and figures. An earlier run's folder is replaced whole, unless something else is in it.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `compare`.
#[derive(Debug, Args)]
pub struct CompareOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
    #[command(flatten)]
    pub targets: TargetOptions,
    /// Window T in ms; by default the one that `design` recommends.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub window_ms: Option<f64>,
    /// Judge on modes up to this frequency, in Hz; by default to twice the band.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    pub judge_hz: Option<f64>,
    /// Folder for the report and figure; without it the table alone is made.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// Options of `field`.
#[derive(Debug, Args)]
pub struct FieldOptions {
    /// A surface file, the name of a built-in surface, or a library of responses.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    /// The drive: a WAV file with one channel per actuator, in the actuators' units.
    #[arg(long, value_name = "WAV")]
    pub drive: PathBuf,
    /// Where to measure, in mm; by default where the field is strongest. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// When to measure, in ms; by default at each place's own peak. Once for all, or once per --at.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub at_ms: Vec<f64>,
    /// A finger resting at X,Y in mm, as the surface file describes fingers. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub finger: Vec<String>,
    /// Period of a repeated drive, in ms: figures are then those of the last full period.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub period_ms: Option<f64>,
    /// Measure on modes up to this frequency, in Hz; by default those of the band.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    pub judge_hz: Option<f64>,
    /// Folder for the report, snapshot, map of peaks and animation; without it only figures in numbers are made.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Start and end of the animation in ms; by default the last 6 ms before the instant and 3 ms after.
    #[arg(long, value_name = "FROM,TO", allow_hyphen_values = true)]
    pub movie_ms: Option<String>,
    /// Frames of the animation; 0 for none.
    #[arg(long, value_name = "N", default_value_t = 60)]
    pub frames: usize,
    /// What stands for a place between the points of a library.
    #[arg(long, value_enum, default_value_t)]
    pub between: BetweenName,
}

/// Options of `reproduce`.
#[derive(Debug, Args)]
pub struct ReproduceOptions {
    /// Folder for the page and its figures. An earlier run's folder is replaced whole, unless something else is in it.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Placements averaged in the statistics of contrast.
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub placements: usize,
}
