//! Options of `unripple verify`.

use super::{BetweenName, DeviceOptions, examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::{each, of, places};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::field::DriveAsk;
use unripple_tasks::text_forms;
use unripple_tasks::verify::Ask;

/// Options of `verify`.
#[derive(Debug, Args)]
#[command(after_help = examples::VERIFY)]
pub struct VerifyOptions {
    /// A surface file, the name of a built-in surface, or a library of responses: what the drive was made for.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    /// The drive: a WAV file with one channel per actuator, in the actuators' units. The `report.json` of `focus` beside it says place and
    /// instant of its focus.
    #[arg(long, value_name = "WAV")]
    pub drive: PathBuf,
    /// Only say what would be played, and how loud: no device is opened.
    #[arg(long)]
    pub dry_run: bool,
    /// The device that plays and records.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// Place at which the drive focuses, in mm; by default that of the first target of the report beside the drive.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub at: Option<String>,
    /// Instant of the focus, in ms; by default that of the report beside the drive, else that of the largest predicted velocity at
    /// the target.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::TARGETS)]
    pub at_ms: Option<f64>,
    /// Place at which the probe records besides the target, in mm; by default some outside the focal disc. Places within the disc tell
    /// the spot. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::POINTS)]
    pub probe_mm: Vec<String>,
    /// Number of places outside the focal disc that are chosen without --probe-mm, at most 64.
    #[arg(long, value_name = "N", default_value_t = 8, help_heading = heading::POINTS)]
    pub probes: usize,
    /// Level at which the drive is played, as a share of the drive as it is.
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, allow_negative_numbers = true, help_heading = heading::LEVEL)]
    pub level: f64,
    /// Velocity that the probe's input at full scale stands for, in m/s; negative for a reversed probe. Without it velocities are
    /// only compared with each other.
    #[arg(long, value_name = "SCALE", allow_negative_numbers = true, help_heading = heading::WIRING)]
    pub probe_scale: Option<f64>,
    /// Use the channel CHANNEL for the actuator or probe called NAME, if the channel has another name. Repeatable.
    #[arg(long, value_name = "NAME=CHANNEL", help_heading = heading::WIRING)]
    pub wire: Vec<String>,
    /// Predict with modes up to this frequency, in Hz; by default up to twice the top of the band, at most 0.45 of the sample rate.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, help_heading = heading::MODEL)]
    pub judge_hz: Option<f64>,
    /// How responses are interpolated for a place between the points of a library.
    #[arg(long, value_enum, default_value_t, help_heading = heading::MODEL)]
    pub between: BetweenName,
    /// Virtual: deviation of the simulated sheet's tension from that in SURFACE, in per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, allow_negative_numbers = true, help_heading = heading::VIRTUAL)]
    pub changed_percent: f64,
    /// Virtual: exchange the wires of two actuators, by their names. Repeatable.
    #[arg(long, value_name = "NAME=NAME", help_heading = heading::VIRTUAL)]
    pub swapped: Vec<String>,
    /// Virtual: magnitude at which the amplifiers clip, as a share of the drive's peak.
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true, help_heading = heading::VIRTUAL)]
    pub clipped: Option<f64>,
}

impl VerifyOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        Ok(Ask {
            surface: common.surface(&self.surface),
            drive: DriveAsk::File(self.drive.clone()),
            device: self.device.ask(),
            target_m: of("--at", self.at.as_deref().map(text_forms::place).transpose())?,
            instant_s: self.at_ms.map(|ms| ms / 1e3),
            probes_m: places(&self.probe_mm, "--probe-mm")?,
            probe_count: self.probes,
            level: self.level,
            probe_scale: self.probe_scale,
            wires: each(&self.wire, "--wire", text_forms::wire)?,
            judge_hz: self.judge_hz,
            between: self.between.into(),
            dry_run: self.dry_run,
            changed: self.changed_percent / 100.0,
            swapped: each(&self.swapped, "--swapped", text_forms::wire)?,
            clipped: self.clipped,
        })
    }
}
