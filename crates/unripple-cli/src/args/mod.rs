//! The options of the command line: lengths in mm, times in ms unless an option says otherwise; and the requests that they make.

mod areas;
mod calibrate;
mod compare;
mod drift;
mod examples;
mod export;
mod field;
mod figures;
mod fit;
mod focus;
mod heading;
mod import;
mod listen;
mod names;
mod optimise;
mod place;
mod play;
mod rerun;
mod sensors;
mod shell;
mod sweep;
mod verify;
mod view;

use crate::common::Common;
use crate::error::CliError;
use crate::typed::{positive, seconds};
pub use areas::AreaOptions;
pub use calibrate::{CalibrateOptions, DeviceOptions};
use clap::{Args, Parser, Subcommand};
pub use compare::CompareOptions;
pub use drift::DriftOptions;
pub use export::ExportOptions;
pub use field::FieldOptions;
pub use figures::FigureOptions;
pub use fit::FitOptions;
pub use focus::{FocusOptions, TargetOptions};
pub use import::ImportOptions;
pub use listen::ListenOptions;
pub use names::{BetweenName, DeviceName, LossName, MethodName, WayName};
pub use optimise::OptimiseOptions;
pub use place::PlaceOptions;
pub use play::{DoctorOptions, PlayOptions};
pub use rerun::RerunOptions;
pub use sensors::SensorsOptions;
pub use shell::{CacheOptions, CompletionsOptions, ManOptions};
use std::path::PathBuf;
pub use sweep::SweepOptions;
use unripple_paper::reproduce;
use unripple_tasks::{design, devices, materials, modes, respond};
pub use verify::VerifyOptions;
pub use view::ViewOptions;

/// Waves that meet under a fingertip: design, simulate and focus a reverberant touch surface.
///
/// SURFACE is a TOML file or the name of a built-in surface, such as hudin-2012. LIBRARY is a folder of impulse responses.
#[derive(Debug, Parser)]
#[command(name = "unripple", version = version(), propagate_version = true, after_help = EXITS)]
pub struct Arguments {
    /// Print the report as one JSON object (SI units) on standard output, everything else on standard error.
    #[arg(long, global = true, help_heading = heading::EVERY)]
    pub json: bool,
    /// Set a key of SURFACE's file to another value, as in sheet.tension_n_per_m=220 or actuator[0].at_mm=[12,31]; `KEY=` removes the
    /// key. Repeatable.
    #[arg(long, global = true, value_name = "KEY=VALUE", help_heading = heading::EVERY)]
    pub set: Vec<String>,
    /// Compute natural frequencies to this relative accuracy, 1e-12 to 0.1, as `--set accuracy=RATIO` does. By default 1e-6 for
    /// `modes`, 1e-4 for `design`, and for other commands 1e-6, or 1e-4 if the surface needs a mesh.
    #[arg(long, global = true, value_name = "RATIO", help_heading = heading::EVERY)]
    pub accuracy: Option<String>,
    /// Print each stage of the work on standard error, with the time since the beginning.
    #[arg(short, long, global = true, conflicts_with = "quiet", help_heading = heading::EVERY)]
    pub verbose: bool,
    /// Print nothing but warnings and errors on standard error.
    #[arg(short, long, global = true, help_heading = heading::EVERY)]
    pub quiet: bool,
    /// The command to perform.
    #[command(subcommand)]
    pub command: Command,
}

/// The configuration file and the exit codes, at the end of the help.
const EXITS: &str =
    "Options that are not given are taken from unripple/config.toml in the user's folder of
configurations ($XDG_CONFIG_HOME or ~/.config; %APPDATA% on Windows), if it is there, or from the file that UNRIPPLE_CONFIG names.
Modes that took more than a second are kept in unripple in the user's folder of caches ($XDG_CACHE_HOME or ~/.cache; %LOCALAPPDATA% on
Windows), or in the folder that UNRIPPLE_CACHE names; with UNRIPPLE_CACHE=off nothing is kept (see unripple cache).
Exit codes: 0 the work is done; 1 it failed, or its result is doubtful; 2 bad usage or bad input.";

/// The version, with the commit that the program was built from where that is known.
fn version() -> &'static str {
    match env!("UNRIPPLE_COMMIT") {
        "" => env!("CARGO_PKG_VERSION"),
        _ => concat!(env!("CARGO_PKG_VERSION"), " (", env!("UNRIPPLE_COMMIT"), ")"),
    }
}

/// The commands of the program, each with its options.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Predict wave speeds, modes, time window, contrast, focal spot and power at the finger.
    Design(DesignOptions),
    /// Compute the modes: natural frequencies and decay times.
    Modes(ModesOptions),
    /// Find where actuators should be, or which of a library's to keep, so that time reversal has the most contrast, and how many are
    /// enough.
    Place(PlaceOptions),
    /// Find where sensors or taps tell a fit most about a surface, with a certificate, and what it would then know.
    Sensors(SensorsOptions),
    /// Compute impulse responses from the model, as a library.
    Respond(RespondOptions),
    /// Compute a drive that focuses on points or shapes, simulate it, and write a report and pictures.
    Focus(FocusOptions),
    /// Compare methods on the same targets, on one surface or several, in one table and one picture.
    Compare(CompareOptions),
    /// Simulate what a given drive does to a surface.
    Field(FieldOptions),
    /// Run a command for many designs (a grid, Sobol points or a list of values of keys and options), by several processes, with the
    /// results in one table; continues after any interruption.
    Sweep(SweepOptions),
    /// Search the designs whose figures are most or least, or the best trade-offs between several figures, with one table of all designs.
    Optimise(OptimiseOptions),
    /// Measure impulse responses through a device, as a library that `focus` and `field` accept in place of a surface.
    Calibrate(CalibrateOptions),
    /// Make a library of responses or modes that other programs measured: universal files, CSV, NPZ, MATLAB and WAV.
    Import(ImportOptions),
    /// Export a library of responses as WAV files, or as one SOFA, universal or MATLAB file.
    Export(ExportOptions),
    /// Drive a surface live: touches in, waves out.
    Play(PlayOptions),
    /// Measure whether the tension of a sheet still has the value for which its responses were measured or computed, and whether
    /// it is changing.
    Drift(DriftOptions),
    /// Play a drive through a device, record a probe at its target and elsewhere, and print measured beside predicted, where they part and
    /// the likeliest causes.
    Verify(VerifyOptions),
    /// Show a surface in a browser: touch it, see its numbers, design it, compare methods.
    View(ViewOptions),
    /// Fit the model to the responses between the actuators of a calibrated library, and compute the fitted model's responses at
    /// any points; or, with --modes, fit a surface to natural frequencies alone.
    Fit(FitOptions),
    /// Find natural frequencies and decay times in the recording of a knock on a surface, for `fit --modes`.
    Listen(ListenOptions),
    /// List all errors of a surface file.
    Check(CheckOptions),
    /// List the materials that surface files may name, with the sources of their values.
    Materials(MaterialsOptions),
    /// List devices that can play a drive: virtual surface, files, sound server, cards.
    Devices(DevicesOptions),
    /// Check each stage from touch to fingertip, and list likely reasons if nothing is felt.
    Doctor(DoctorOptions),
    /// Reproduce the table and figures of Hudin et al. (2012), with our results beside the paper's, as one page.
    Reproduce(ReproduceOptions),
    /// Run again what a report records: the same options, seeds and surfaces, on the same files.
    Rerun(RerunOptions),
    /// Show the cache of computed modes on this machine, or empty it.
    Cache(CacheOptions),
    /// Print a script that lets a shell complete commands and options.
    Completions(CompletionsOptions),
    /// Write manual pages, one for each command.
    Man(ManOptions),
}

/// Options of `check`.
#[derive(Debug, Args)]
#[command(after_help = examples::CHECK)]
pub struct CheckOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
}

/// Options of `materials`.
#[derive(Debug, Args)]
#[command(after_help = examples::MATERIALS)]
pub struct MaterialsOptions {
    /// Name of one material; by default all are listed.
    pub name: Option<String>,
}

impl MaterialsOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<materials::Ask, CliError> {
        common.without_surface()?;
        Ok(materials::Ask { name: self.name.clone() })
    }
}

/// Options of `devices`.
#[derive(Debug, Args)]
#[command(after_help = examples::DEVICES)]
pub struct DevicesOptions {
    /// Name of the JACK server to query; by default JACK's default server.
    #[arg(long, value_name = "NAME")]
    pub server: Option<String>,
}

impl DevicesOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<devices::Ask, CliError> {
        common.without_surface()?;
        Ok(devices::Ask { server: self.server.clone() })
    }
}

/// Options of `design`.
#[derive(Debug, Args)]
#[command(after_help = examples::DESIGN)]
pub struct DesignOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
}

impl DesignOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> design::Ask {
        design::Ask { surface: common.surface(&self.surface) }
    }
}

/// Options of `modes`.
#[derive(Debug, Args)]
#[command(after_help = examples::MODES)]
pub struct ModesOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
    /// Highest frequency, in Hz; by default the top of the surface's band.
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    pub max_hz: Option<f64>,
}

impl ModesOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> modes::Ask {
        modes::Ask { surface: common.surface(&self.surface), top_hz: self.max_hz, ..modes::Ask::default() }
    }
}

/// Options of `respond`.
#[derive(Debug, Args)]
#[command(after_help = examples::RESPOND)]
pub struct RespondOptions {
    /// A surface file, or the name of a built-in surface.
    pub surface: String,
    /// Spacing of the points, in mm. Points lie at multiples of the spacing along both axes; points closer to the edge than a
    /// quarter of the spacing are left out.
    #[arg(long, value_name = "P", allow_negative_numbers = true)]
    pub grid_mm: f64,
    /// Length of the responses in ms, at most 60 000; by default twice the window that `design` recommends.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub length_ms: Option<f64>,
    /// Folder of the library. An unfinished library with the same options is continued.
    #[arg(short, long, value_name = "LIBRARY")]
    pub output: PathBuf,
}

impl RespondOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<respond::Ask, CliError> {
        Ok(respond::Ask {
            surface: common.surface(&self.surface),
            pitch_m: positive(self.grid_mm, "--grid-mm", "mm")? / 1e3,
            length_s: seconds(self.length_ms, "--length-ms")?,
            output: self.output.clone(),
        })
    }
}

/// Options of `reproduce`.
#[derive(Debug, Args)]
#[command(after_help = examples::REPRODUCE)]
pub struct ReproduceOptions {
    /// Folder for the page and its pictures. An existing folder is replaced only if it holds nothing but the unchanged files of
    /// an earlier run.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Number of random placements of the actuators over which contrast is averaged, 2 to 10 000.
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub placements: usize,
}

impl ReproduceOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<reproduce::Ask, CliError> {
        common.without_surface()?;
        Ok(reproduce::Ask { output: Some(self.output.clone()), placements: self.placements })
    }
}
