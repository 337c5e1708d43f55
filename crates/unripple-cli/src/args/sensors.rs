//! Options of `unripple sensors`.

use super::{AreaOptions, FigureOptions, examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::places;
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::sensors::{Ask, SensingAsk};

/// Options of `sensors`.
#[derive(Debug, Args)]
#[command(after_help = examples::SENSORS)]
pub struct SensorsOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
    /// Number of places to plan.
    #[arg(long, value_name = "N", default_value_t = 4, help_heading = heading::PLACES)]
    pub count: usize,
    /// Plan taps, which the sensors of all actuators record, in place of a sensor that records sweeps.
    #[arg(long, help_heading = heading::MODEL)]
    pub taps: bool,
    /// A place that is measured in any case, in mm, beside --count others. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::PLACES)]
    pub keep: Vec<String>,
    #[command(flatten)]
    pub areas: AreaOptions,
    /// Spacing of the grid of places to choose from, in mm; by default a quarter of the shortest wavelength.
    #[arg(long, value_name = "P", allow_negative_numbers = true, help_heading = heading::PLACES)]
    pub grid_mm: Option<f64>,
    /// Least distance between any two places, in mm.
    #[arg(long, value_name = "D", default_value_t = 0.0, allow_negative_numbers = true, help_heading = heading::PLACES)]
    pub apart_mm: f64,
    /// Signal-to-noise ratio of the measured spectra in dB, the mean over all places.
    #[arg(long, value_name = "DB", default_value_t = 50.0, allow_negative_numbers = true, help_heading = heading::MODEL)]
    pub snr_db: f64,
    /// Largest number of half waves, both directions together, in the variation of tension over the sheet that is fitted; 0 for uniform
    /// tension.
    #[arg(long, value_name = "N", default_value_t = 3, help_heading = heading::MODEL)]
    pub profile: usize,
    /// Number of random choices that the search begins from, beside the greedy one.
    #[arg(long, value_name = "N", default_value_t = 10, help_heading = heading::SEARCH)]
    pub restarts: usize,
    /// Seed of the random choices.
    #[arg(long, value_name = "SEED", default_value_t = 1, help_heading = heading::SEARCH)]
    pub seed: u64,
    /// Largest number of places in the table of deviations against their number, at least --count; by default twice that.
    #[arg(long, value_name = "N", help_heading = heading::SEARCH)]
    pub up_to: Option<usize>,
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Folder for report and pictures; without it the report is only printed.
    #[arg(short, long, value_name = "DIR", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
}

impl SensorsOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        Ok(Ask {
            surface: common.surface(&self.surface),
            count: self.count,
            sensing: if self.taps { SensingAsk::Taps } else { SensingAsk::Sweeps },
            keep_m: places(&self.keep, "--keep")?,
            rim_m: self.areas.rim()?,
            within_m: self.areas.within()?,
            keep_out_m: self.areas.keep_out()?,
            places_m: self.areas.places()?,
            pitch_m: self.grid_mm.map(|mm| mm / 1e3),
            apart_m: self.apart_mm / 1e3,
            snr_db: self.snr_db,
            profile: self.profile,
            restarts: self.restarts,
            seed: self.seed,
            up_to: self.up_to,
            output: self.output.clone(),
            no_figures: self.figures.no_figures,
            columns: self.figures.columns,
        })
    }
}
