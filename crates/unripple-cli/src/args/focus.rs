//! Options of `unripple focus`, and of targets.

use super::{BetweenName, FigureOptions, LossName, MethodName, examples, heading};
use crate::error::CliError;
use crate::typed;
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::target::{LevelAsk, PointAsk, ShapeAsk};
use unripple_tasks::text_forms;

/// Where to focus, and how strongly.
#[derive(Debug, Args)]
pub struct TargetOptions {
    /// A point to focus on, in mm, with an optional gain and an optional repetition rate in Hz. Repeatable.
    #[arg(long, value_name = "X,Y[,GAIN[,HZ]]", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub at: Vec<String>,
    /// A shape to focus on, in mm: an SVG file, triangle:X,Y,SIZE or circle:X,Y,R. Repeatable.
    #[arg(long, value_name = "SHAPE", help_heading = heading::TARGETS)]
    pub shape: Vec<String>,
    /// Peak displacement at the first target, in µm. The default is the level at which no point of the sheet moves by more than
    /// about half the sheet's thickness.
    #[arg(long, value_name = "UM", allow_negative_numbers = true, help_heading = heading::LEVEL)]
    pub peak_um: Option<f64>,
    /// Level felt at the first target, in dB above the threshold of touch, that the drive is to reach.
    #[arg(long, value_name = "L", allow_negative_numbers = true, conflicts_with = "peak_um", help_heading = heading::LEVEL)]
    pub felt_db: Option<f64>,
    /// Drive at the surface's drive limit, even if linear theory does not hold there.
    #[arg(long, conflicts_with_all = ["peak_um", "felt_db"], help_heading = heading::LEVEL)]
    pub full_limit: bool,
    /// A waveform at a point in mm: sine:HZ,MS, burst:HZ,CYCLES, click:MS or a WAV file, with its peak in µm. Repeatable.
    #[arg(long, value_name = "X,Y,WHAT[,UM]", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub waveform: Vec<String>,
    /// A point in mm that must stay still while waveforms play. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub silent: Vec<String>,
    /// A path in mm along which a focus moves: line:X1,Y1,X2,Y2, a shape as for --shape, or an SVG file.
    #[arg(long, value_name = "PATH", help_heading = heading::TARGETS)]
    pub path: Option<String>,
    /// Speed of the focus along the path, in mm/s.
    #[arg(long, value_name = "V", allow_negative_numbers = true, help_heading = heading::TARGETS)]
    pub speed_mm_s: Option<f64>,
    /// Peak velocity of the sheet at each pulse along the path, in mm/s; 10 by default.
    #[arg(long, value_name = "V", allow_negative_numbers = true, help_heading = heading::LEVEL)]
    pub level_mm_s: Option<f64>,
}

impl TargetOptions {
    /// The points to focus on, in the order typed.
    pub fn points(&self) -> Result<Vec<PointAsk>, CliError> {
        typed::each(&self.at, "--at", text_forms::point)
    }

    /// The shapes to focus on, in the order typed.
    pub fn shapes(&self) -> Result<Vec<ShapeAsk>, CliError> {
        typed::each(&self.shape, "--shape", text_forms::shape)
    }

    /// The level of the drive that the options ask for.
    pub fn level(&self) -> Result<LevelAsk, CliError> {
        Ok(match (self.felt_db, self.peak_um, self.full_limit) {
            (Some(db), ..) => LevelAsk::FeltDb(db),
            (None, Some(um), _) => LevelAsk::PeakM(typed::positive(um, "--peak-um", "µm")? / 1e6),
            (None, None, true) => LevelAsk::Limit,
            (None, None, false) => LevelAsk::Linear,
        })
    }
}

/// Options of `focus`.
#[derive(Debug, Args)]
#[command(after_help = examples::FOCUS)]
pub struct FocusOptions {
    /// A surface file, the name of a built-in surface, or a library of responses.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    #[command(flatten)]
    pub targets: TargetOptions,
    /// Method of focusing.
    #[arg(long, value_enum, default_value_t = MethodName::TimeReversal, help_heading = heading::METHOD)]
    pub method: MethodName,
    /// For `inverse`, `concentrate`, `limited` and `robust`: weight of the velocity that the method minimises against the drive's
    /// energy, from 0 (time reversal) to 1 (velocity alone); by default 0.945 to 0.985, depending on the method.
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true, help_heading = heading::METHOD)]
    pub strength: Option<f64>,
    /// For `limited`: peak velocity to reach, from that of the unconstrained drive scaled to the limit (0) to that of one-bit
    /// (1).
    #[arg(long, value_name = "SHARE", default_value_t = 0.5, allow_negative_numbers = true, help_heading = heading::METHOD)]
    pub push: f64,
    /// Limit on the rms of all actuators together (root of the sum of their mean squares), in the drive's unit.
    #[arg(long, value_name = "RMS", allow_negative_numbers = true, help_heading = heading::LEVEL)]
    pub total_rms: Option<f64>,
    /// For `robust`: shift of all natural frequencies, up and down, that the drive must tolerate, in per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.5, allow_negative_numbers = true, help_heading = heading::METHOD)]
    pub spread_percent: f64,
    /// For `felt`: minimise the rms felt elsewhere (0), the largest level felt elsewhere (1), or a mixture.
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true, help_heading = heading::METHOD)]
    pub worst: Option<f64>,
    /// For `felt`: weight of the drive's energy in the objective.
    #[arg(long, value_name = "WEIGHT", allow_negative_numbers = true, help_heading = heading::METHOD)]
    pub economy: Option<f64>,
    /// For `inverse`: minimise displacements elsewhere as well as velocities.
    #[arg(long, help_heading = heading::METHOD)]
    pub rest: bool,
    /// Window T in ms; by default the one that `design` recommends.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::TIME)]
    pub window_ms: Option<f64>,
    /// How responses are interpolated for a target between the points of a library.
    #[arg(long, value_enum, default_value_t, help_heading = heading::SIMULATION)]
    pub between: BetweenName,
    /// For `time-reversal` and `one-bit`: how the drive compensates the decay of the waves.
    #[arg(long, value_enum, default_value_t = LossName::None, help_heading = heading::METHOD)]
    pub losses: LossName,
    /// Length of the drive in ms if a target has a repetition rate; by default long enough for a periodic steady state.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::TIME)]
    pub duration_ms: Option<f64>,
    /// Simulate the drive with a finger resting at X,Y in mm; the drive itself is computed without it. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::SIMULATION)]
    pub finger: Vec<String>,
    /// Compute the drive for the surface with the fingers of --finger on it.
    #[arg(long, help_heading = heading::METHOD)]
    pub finger_aware: bool,
    /// For `robust`: error of the tension, up and down, that the drive must tolerate as well, in per cent.
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, help_heading = heading::METHOD)]
    pub bear_tension_percent: Option<f64>,
    /// For `robust`: place X,Y in mm of a finger whose presence and absence the drive must tolerate as well. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::METHOD)]
    pub bear_finger: Vec<String>,
    /// Simulate the drive on this surface instead of the surface or library that it was computed for.
    #[arg(long, value_name = "SURFACE", help_heading = heading::SIMULATION)]
    pub on: Option<String>,
    /// Simulate the drive with modes up to this frequency, in Hz; by default up to twice the top of the band (for waveforms three
    /// times), at most 0.45 of the sample rate.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, help_heading = heading::SIMULATION)]
    pub judge_hz: Option<f64>,
    /// Height above the middle of the surface, in m, at which the sound pressure level is computed: 0.05 to 100, 0.3 by default.
    #[arg(long, value_name = "M", allow_negative_numbers = true, help_heading = heading::SIMULATION)]
    pub listen_m: Option<f64>,
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Folder for drive.wav, report.json, report.md and pictures. An existing folder is replaced only if it holds nothing but
    /// the unchanged files of an earlier run.
    #[arg(short, long, value_name = "DIR", help_heading = heading::RESULTS)]
    pub output: PathBuf,
}
