//! Options of `unripple fit`.

use clap::Args;
use std::path::PathBuf;

/// Options of `fit`.
#[derive(Debug, Args)]
pub struct FitOptions {
    /// A library that `calibrate` made on a device whose actuators listen: its last points are what they hear of each other.
    #[arg(value_name = "LIBRARY")]
    pub library: String,
    /// Distance of the points of a square grid where responses of the fitted model are wanted, in mm.
    #[arg(long, value_name = "P", allow_negative_numbers = true, requires = "output")]
    pub grid_mm: Option<f64>,
    /// A point in mm where they are wanted. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, requires = "output")]
    pub at: Vec<String>,
    /// Stray masses that may be found.
    #[arg(long, value_name = "N", default_value_t = 3)]
    pub strays: usize,
    /// Half waves that the tension's profile over the sheet may have; 0 for an even tension.
    #[arg(long, value_name = "N", default_value_t = 3)]
    pub profile: usize,
    /// Write the library even if the model is doubtful; it says so then, and commands that use it warn.
    #[arg(long, requires = "output")]
    pub even_if_doubtful: bool,
    /// Library of the fitted model's responses, blended with what was measured at points nearby. Needs --grid-mm or --at.
    #[arg(short, long, value_name = "FITTED_LIBRARY")]
    pub output: Option<PathBuf>,
}
