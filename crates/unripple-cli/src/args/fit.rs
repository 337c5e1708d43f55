//! Options of `unripple fit`.

use super::{examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::{metres, of, places};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::fit::Ask;
use unripple_tasks::fit_modes::{self, ModeAsk};
use unripple_tasks::text_forms::frequencies;

/// Options of `fit`.
#[derive(Debug, Args)]
#[command(after_help = examples::FIT)]
pub struct FitOptions {
    /// A library that `calibrate` measured with actuators that also sense: it contains the responses between actuators, to which
    /// the model is fitted. With --modes, a surface file, or the name of a built-in surface.
    #[arg(value_name = "LIBRARY|SURFACE")]
    pub library: String,
    /// Natural frequencies in Hz, to which a surface is fitted without any other measurement, in any order and not necessarily all; each
    /// with its decay time in ms behind a colon, or with its quality factor behind a colon and a Q, if that was measured.
    #[arg(
        long,
        value_name = "HZ[:MS],…",
        allow_hyphen_values = true,
        conflicts_with_all = ["grid_mm", "at", "strays", "profile", "even_if_doubtful"],
        help_heading = heading::FREQUENCIES
    )]
    pub modes: Option<String>,
    /// Quantities to fit to --modes, separated by commas: tension, modulus, young-along, young-across, shear, spring, lift, tilt, or
    /// spring-1 and so on for one side. By default the tension of a film, the modulus of a plate (all three with grain), and springs.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', requires = "modes", help_heading = heading::FREQUENCIES)]
    pub free: Vec<String>,
    /// Standard deviation of --modes, and of the model, in per cent; by default 1.
    #[arg(long, value_name = "P", allow_negative_numbers = true, requires = "modes", help_heading = heading::FREQUENCIES)]
    pub error_percent: Option<f64>,
    /// Which side is held in which way is certain: do not try others.
    #[arg(long, requires = "modes", help_heading = heading::FREQUENCIES)]
    pub sides_known: bool,
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
    /// or --at. With --modes, folder for the report, the fitted surface file and pictures.
    #[arg(short, long, value_name = "FITTED_LIBRARY|DIR", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
    /// With --modes: write no pictures.
    #[arg(long, requires = "modes", help_heading = heading::RESULTS)]
    pub no_figures: bool,
    /// With --modes: width of the pictures, in columns of a printed page: 1 (86 mm) or 2 (178 mm).
    #[arg(long, value_name = "1|2", requires = "modes", help_heading = heading::RESULTS)]
    pub columns: Option<usize>,
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

    /// Converts the options to a request of a fit to frequencies, if there are some.
    pub fn of_modes(&self, common: &Common) -> Result<Option<fit_modes::Ask>, CliError> {
        let Some(text) = &self.modes else { return Ok(None) };
        let one = |(frequency_hz, decay_time_s): (f64, Option<f64>)| ModeAsk { frequency_hz, decay_time_s };
        let usual = fit_modes::Ask::default();
        Ok(Some(fit_modes::Ask {
            surface: common.surface(&self.library),
            modes: of("--modes", frequencies(text))?.into_iter().map(one).collect(),
            free: self.free.iter().map(|name| name.trim().to_owned()).collect(),
            error: self.error_percent.map_or(usual.error, |percent| percent / 100.0),
            sides_known: self.sides_known,
            output: self.output.clone(),
            no_figures: self.no_figures,
            columns: self.columns,
        }))
    }
}
