//! Options of `unripple fit`.

use super::{examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::{metres, places};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::fit::Ask;

/// Options of `fit`.
#[derive(Debug, Args)]
#[command(after_help = examples::FIT)]
pub struct FitOptions {
    /// A library that `calibrate` measured with actuators that also sense: it contains the responses between actuators, to which
    /// the model is fitted.
    #[arg(value_name = "LIBRARY")]
    pub library: String,
    /// Spacing of a square grid of points for the responses of the fitted model, in mm.
    #[arg(long, value_name = "P", allow_negative_numbers = true, requires = "output", help_heading = heading::RESULTS)]
    pub grid_mm: Option<f64>,
    /// A point for the responses of the fitted model, in mm; nothing needs to have been measured there. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, requires = "output", help_heading = heading::RESULTS)]
    pub at: Vec<String>,
    /// Largest number of unknown point masses to fit.
    #[arg(long, value_name = "N", default_value_t = 3, help_heading = heading::MODEL)]
    pub strays: usize,
    /// Largest number of half waves, along x and y together, in the fitted variation of tension over the sheet; 0 for uniform
    /// tension.
    #[arg(long, value_name = "N", default_value_t = 3, help_heading = heading::MODEL)]
    pub profile: usize,
    /// Write the library even if the model is doubtful; the library is then marked, and commands that use it warn.
    #[arg(long, requires = "output", help_heading = heading::RESULTS)]
    pub even_if_doubtful: bool,
    /// Library to write, with responses of the fitted model, corrected by measured responses near their points. Needs --grid-mm
    /// or --at.
    #[arg(short, long, value_name = "FITTED_LIBRARY", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
}

impl FitOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        Ok(Ask {
            accuracy: common.accuracy_alone()?,
            library: self.library.clone().into(),
            pitch_m: metres(self.grid_mm, "--grid-mm")?,
            points_m: places(&self.at, "--at")?,
            strays: self.strays,
            profile: self.profile,
            even_if_doubtful: self.even_if_doubtful,
            output: self.output.clone(),
        })
    }
}
