//! Options of `unripple drift`.

use super::DeviceOptions;
use clap::Args;

/// Options of `drift`.
#[derive(Debug, Args)]
pub struct DriftOptions {
    /// A surface file, the name of a built-in surface, or a library that `calibrate` measured with actuators that listen, or that `fit`
    /// wrote.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    /// What plays and listens.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// Seconds of pings, which nobody feels; two and a half in a second.
    #[arg(long, value_name = "S", default_value_t = 4.0, allow_negative_numbers = true)]
    pub seconds: f64,
    /// Largest change of tension that is looked for, up and down, in per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 8.0, allow_negative_numbers = true)]
    pub within_percent: f64,
    /// Virtual: the true tension is another by so many per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, allow_negative_numbers = true)]
    pub changed_percent: f64,
    /// Virtual: it changes by so many per cent a minute.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, allow_negative_numbers = true)]
    pub changing_percent_per_min: f64,
}
