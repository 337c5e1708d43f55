//! Options of `unripple view`.

use super::{DeviceOptions, MethodName, examples, heading};
use clap::Args;
use std::net::IpAddr;
use std::path::PathBuf;

/// Options of `view`.
#[derive(Debug, Args)]
#[command(after_help = examples::VIEW)]
pub struct ViewOptions {
    /// A surface file, the name of a built-in surface, or a library of responses.
    #[arg(value_name = "SURFACE|LIBRARY", default_value = "hudin-2012")]
    pub surface: String,
    /// The device that plays and records.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// Method of focusing to begin with; the page can change it.
    #[arg(long, value_enum, default_value = "time-reversal")]
    pub method: MethodName,
    /// Estimate the tension of the sheet from the sensor signals of the actuators and compute drives for it, on a real device or
    /// with --unknowns.
    #[arg(long)]
    pub follow_tension: bool,
    /// TCP port; 0 for any free one.
    #[arg(long, value_name = "PORT", default_value_t = 8417, help_heading = heading::NETWORK)]
    pub port: u16,
    /// Address to listen at, such as 0.0.0.0, so that other machines can see and touch the surface. The printed address then
    /// contains an access token.
    #[arg(long, value_name = "ADDRESS", help_heading = heading::NETWORK)]
    pub listen: Option<IpAddr>,
    /// The access token in the address, 8 to 64 letters and digits; by default a new one at each start.
    #[arg(long, value_name = "TOKEN", help_heading = heading::NETWORK)]
    pub token: Option<String>,
    /// Let pages of this origin show the page in a frame: scheme://host[:port], where the port of localhost and 127.0.0.1 may be *,
    /// as for JupyterLab on this machine. Repeatable. By default no page may.
    #[arg(long, value_name = "ORIGIN", help_heading = heading::NETWORK)]
    pub framed_by: Vec<String>,
    /// Do not open a browser.
    #[arg(long, help_heading = heading::NETWORK)]
    pub no_browser: bool,
    /// Folder for libraries that are calibrated from the page.
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub folder: PathBuf,
    /// Seconds to run; by default until interrupted.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// End when standard input ends. This is for a program that starts the viewer through a pipe: the viewer then ends with that
    /// program, even if the program crashes.
    #[arg(long)]
    pub until_input_ends: bool,
}
