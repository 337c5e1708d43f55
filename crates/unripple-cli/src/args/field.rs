//! Options of `unripple field`.

use super::{BetweenName, FigureOptions, examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::{of, places, seconds};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::field::{Ask, DriveAsk};
use unripple_tasks::text_forms;

/// Options of `field`.
#[derive(Debug, Args)]
#[command(after_help = examples::FIELD)]
pub struct FieldOptions {
    /// A surface file, the name of a built-in surface, or a library of responses.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    /// The drive: a WAV file with one channel per actuator, in the actuators' units.
    #[arg(long, value_name = "WAV", help_heading = heading::SIMULATION)]
    pub drive: PathBuf,
    /// Place to evaluate, in mm; by default where the velocity is largest. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub at: Vec<String>,
    /// Instant to evaluate, in ms; by default that of the largest velocity at each place. Give one for all places, or one for
    /// each --at.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::TARGETS)]
    pub at_ms: Vec<f64>,
    /// Simulate the field with a finger, as the surface file describes it, resting at X,Y in mm. Repeatable.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = heading::SIMULATION)]
    pub finger: Vec<String>,
    /// Period of a repeated drive, in ms; results are then those of the last full period.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::SIMULATION)]
    pub period_ms: Option<f64>,
    /// Simulate the field with modes up to this frequency, in Hz; by default up to twice the top of the band, at most 0.45 of the
    /// sample rate.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, help_heading = heading::SIMULATION)]
    pub judge_hz: Option<f64>,
    /// Height above the middle of the surface, in m, at which the sound pressure level is computed: 0.05 to 100, 0.3 by default.
    #[arg(long, value_name = "M", allow_negative_numbers = true, help_heading = heading::SIMULATION)]
    pub listen_m: Option<f64>,
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Folder for the report, snapshot, map of peaks and animation; without it only the report is printed.
    #[arg(short, long, value_name = "DIR", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
    /// Start and end of the animation in ms; by default from 6 ms before the evaluated instant to 3 ms after it.
    #[arg(long, value_name = "FROM,TO", allow_hyphen_values = true, help_heading = heading::RESULTS)]
    pub movie_ms: Option<String>,
    /// Frames of the animation, at most 5000; 0 for none.
    #[arg(long, value_name = "N", default_value_t = 60, help_heading = heading::RESULTS)]
    pub frames: usize,
    /// How responses are interpolated for a place between the points of a library.
    #[arg(long, value_enum, default_value_t, help_heading = heading::SIMULATION)]
    pub between: BetweenName,
}

impl FieldOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        Ok(Ask {
            surface: common.surface(&self.surface),
            drive: DriveAsk::File(self.drive.clone()),
            points_m: places(&self.at, "--at")?,
            instants_s: self.at_ms.iter().map(|ms| ms / 1e3).collect(),
            fingers_m: places(&self.finger, "--finger")?,
            period_s: seconds(self.period_ms, "--period-ms")?,
            judge_hz: self.judge_hz,
            listen_m: self.listen_m,
            output: self.output.clone(),
            no_figures: self.figures.no_figures,
            columns: self.figures.columns,
            movie_s: of("--movie-ms", self.movie_ms.as_deref().map(text_forms::interval).transpose())?,
            frames: self.frames,
            between: self.between.into(),
        })
    }
}
