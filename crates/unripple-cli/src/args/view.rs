//! Options of `unripple view`.

use super::{DeviceOptions, MethodName};
use clap::Args;
use std::net::IpAddr;
use std::path::PathBuf;

/// Options of `view`.
#[derive(Debug, Args)]
pub struct ViewOptions {
    /// A surface file, the name of a built-in surface, or a library of responses.
    #[arg(value_name = "SURFACE|LIBRARY", default_value = "hudin-2012")]
    pub surface: String,
    /// What plays and listens.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// How drives are made at first.
    #[arg(long, value_enum, default_value = "time-reversal")]
    pub method: MethodName,
    /// Follow the tension of the sheet, by what the actuators hear: of a real device, or with --unknowns.
    #[arg(long)]
    pub follow_tension: bool,
    /// TCP port; 0 takes any that is free.
    #[arg(long, value_name = "PORT", default_value_t = 8417)]
    pub port: u16,
    /// Let others see and touch: the address to listen at, such as 0.0.0.0. Their address then holds a token.
    #[arg(long, value_name = "ADDRESS")]
    pub listen: Option<IpAddr>,
    /// The token, where it is to be the same each time: 8 to 64 letters and digits. A new one each time otherwise.
    #[arg(long, value_name = "TOKEN")]
    pub token: Option<String>,
    /// Open no browser.
    #[arg(long)]
    pub no_browser: bool,
    /// Folder for libraries that are calibrated from the page.
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub folder: PathBuf,
    /// Seconds to serve; without it until interrupted.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub seconds: Option<f64>,
}
