//! Options of `unripple drift`.

use super::{DeviceOptions, examples, heading};
use crate::common::Common;
use clap::Args;
use unripple_tasks::drift::Ask;

/// Options of `drift`.
#[derive(Debug, Args)]
#[command(after_help = examples::DRIFT)]
pub struct DriftOptions {
    /// A surface file, the name of a built-in surface, or a library that `calibrate` measured with sensors at the actuators, or that `fit`
    /// wrote.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    /// The device that plays and records.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// Duration of the sequence of pings, in s. Pings are test signals too weak to be felt, two and a half per second.
    #[arg(long, value_name = "S", default_value_t = 4.0, allow_negative_numbers = true)]
    pub seconds: f64,
    /// Largest change of tension that is searched for, up and down, in per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 8.0, allow_negative_numbers = true)]
    pub within_percent: f64,
    /// Virtual: deviation of the simulated sheet's tension at the start from that in SURFACE, in per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, allow_negative_numbers = true, help_heading = heading::VIRTUAL)]
    pub changed_percent: f64,
    /// Virtual: rate at which the simulated sheet's tension changes, in per cent per minute.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, allow_negative_numbers = true, help_heading = heading::VIRTUAL)]
    pub changing_percent_per_min: f64,
}

impl DriftOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Ask {
        Ask {
            surface: common.surface(&self.surface),
            device: self.device.ask(),
            seconds: self.seconds,
            range: self.within_percent / 100.0,
            changed: self.changed_percent / 100.0,
            changing_per_min: self.changing_percent_per_min / 100.0,
        }
    }
}
