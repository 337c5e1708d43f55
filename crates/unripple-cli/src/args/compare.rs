//! Options of `unripple compare`.

use super::{MethodName, TargetOptions, examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::seconds;
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::compare::Ask;
use unripple_tasks::{SurfaceAsk, text_forms};

/// Options of `compare`.
#[derive(Debug, Args)]
#[command(after_help = examples::COMPARE)]
pub struct CompareOptions {
    /// Surface files, names of built-in surfaces, or libraries of responses.
    #[arg(required = true)]
    pub surface: Vec<String>,
    /// Compare variants of each surface, one for each value of a key of its file, as in sheet.tension_n_per_m=200,300,400.
    #[arg(long, value_name = "KEY=VALUE,VALUE", help_heading = heading::SURFACES)]
    pub vary: Option<String>,
    #[command(flatten)]
    pub targets: TargetOptions,
    /// Method to compare with time reversal; by default every method if there is one surface, only `concentrate` if there are several.
    /// Repeatable.
    #[arg(long, value_enum, help_heading = heading::METHOD)]
    pub method: Vec<MethodName>,
    /// Window T in ms; by default the one that `design` recommends for each surface.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::TIME)]
    pub window_ms: Option<f64>,
    /// Simulate drives with modes up to this frequency, in Hz; by default up to twice the top of the band, at most 0.45 of the
    /// sample rate.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, help_heading = heading::SIMULATION)]
    pub judge_hz: Option<f64>,
    /// Height above the middle of the surface, in m, at which the sound pressure level is computed: 0.05 to 100, 0.3 by default.
    #[arg(long, value_name = "M", allow_negative_numbers = true, help_heading = heading::SIMULATION)]
    pub listen_m: Option<f64>,
    /// Write no pictures.
    #[arg(long, help_heading = heading::RESULTS)]
    pub no_figures: bool,
    /// Width of the picture, in columns of a printed page: 1 (86 mm) or 2 (178 mm, the default).
    #[arg(long, value_name = "1|2", help_heading = heading::RESULTS)]
    pub columns: Option<usize>,
    /// Folder for the report and picture; without it only the table is printed.
    #[arg(short, long, value_name = "DIR", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
}

impl CompareOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        let (surfaces, labels) = self.surfaces(common)?;
        let mut surfaces = surfaces.into_iter();
        Ok(Ask {
            surface: surfaces.next().unwrap_or_default(),
            others: surfaces.collect(),
            labels,
            methods: self.method.iter().copied().map(Into::into).collect(),
            points: self.targets.points()?,
            shapes: self.targets.shapes()?,
            level: self.targets.level()?,
            window_s: seconds(self.window_ms, "--window-ms")?,
            judge_hz: self.judge_hz,
            listen_m: self.listen_m,
            // They take half of the time, and no table shows them.
            no_tradeoffs: !(common.json || self.output.is_some()),
            no_figures: self.no_figures,
            columns: self.columns,
            output: self.output.clone(),
        })
    }

    /// The surfaces in the order typed, with `--vary` each of them once for each value; and what they are called then.
    fn surfaces(&self, common: &Common) -> Result<(Vec<SurfaceAsk>, Vec<String>), CliError> {
        let names = &self.surface;
        let Some(vary) = &self.vary else {
            return Ok((names.iter().map(|name| common.surface(name)).collect(), Vec::new()));
        };
        let refused = |expected: &str| CliError::Input(format!("--vary {vary}: expected {expected}"));
        let (key, values) = text_forms::key_and_value(vary)
            .ok_or_else(|| refused("KEY=VALUE,VALUE, as in sheet.tension_n_per_m=200,300,400"))?;
        let (mut surfaces, mut labels) = (Vec::new(), Vec::new());
        for name in names {
            for value in text_forms::values(values) {
                let surface = common.surface_with(name, key, value);
                surfaces.push(surface.ok_or_else(|| refused("a key that --set does not set"))?);
                labels.push(match names.len() {
                    1 => format!("{key}={value}"),
                    _ => format!("{name}, {key}={value}"),
                });
            }
        }
        Ok((surfaces, labels))
    }
}
