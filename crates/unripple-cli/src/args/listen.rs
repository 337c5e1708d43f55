//! Options of `unripple listen`.

use super::{FigureOptions, examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::of;
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::listen::Ask;
use unripple_tasks::text_forms::band;

/// Options of `listen`.
#[derive(Debug, Args)]
#[command(after_help = examples::LISTEN)]
pub struct ListenOptions {
    /// A WAV file with the sound or the motion of a surface that was knocked on.
    #[arg(value_name = "RECORDING")]
    pub recording: PathBuf,
    /// Channel of the file, from 1; by default the loudest.
    #[arg(long, value_name = "N", help_heading = heading::FREQUENCIES)]
    pub channel: Option<usize>,
    /// Lowest and highest frequency in Hz; by default 20 to 5000, but no more than four tenths of the sample rate.
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true, help_heading = heading::FREQUENCIES)]
    pub band_hz: Option<String>,
    /// Frequency of the mains, whose hum is no mode, in Hz; by default 50 or 60, whichever is heard.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, help_heading = heading::FREQUENCIES)]
    pub mains_hz: Option<f64>,
    /// Number of the hit to listen to, from 1; by default the last.
    #[arg(long, value_name = "N", help_heading = heading::FREQUENCIES)]
    pub hit: Option<usize>,
    /// Largest number of modes, the strongest ones.
    #[arg(long, value_name = "N", default_value_t = 30, help_heading = heading::FREQUENCIES)]
    pub most: usize,
    /// Least level of a mode relative to the strongest, in dB.
    #[arg(long, value_name = "DB", default_value_t = -60.0, allow_negative_numbers = true, help_heading = heading::FREQUENCIES)]
    pub least_db: f64,
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Folder for report and pictures; without it the report is only printed.
    #[arg(short, long, value_name = "DIR", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
}

impl ListenOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        common.without_surface()?;
        Ok(Ask {
            recording: self.recording.clone(),
            channel: self.channel,
            band_hz: of("--band-hz", self.band_hz.as_deref().map(band).transpose())?,
            mains_hz: self.mains_hz,
            hit: self.hit,
            most: self.most,
            least_db: self.least_db,
            output: self.output.clone(),
            no_figures: self.figures.no_figures,
            columns: self.figures.columns,
        })
    }
}
