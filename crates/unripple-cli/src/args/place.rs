//! Options of `unripple place`.

use super::names::{FigureName, MethodName, ObjectiveName};
use super::{AreaOptions, FigureOptions, examples, heading};
use crate::common::Common;
use crate::error::CliError;
use crate::typed::{each, of, seconds};
use clap::Args;
use std::path::PathBuf;
use unripple_tasks::place::{Ask, ImportantAsk};
use unripple_tasks::text_forms::{polygon, weighted, weighted_polygon};

/// Options of `place`.
#[derive(Debug, Args)]
#[command(after_help = examples::PLACE)]
pub struct PlaceOptions {
    /// A surface file, the name of a built-in surface, or a library of responses, of whose actuators some are chosen.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    /// Number of actuators to place, or to choose from a library.
    #[arg(long, value_name = "N", default_value_t = 8, help_heading = heading::ACTUATORS)]
    pub count: usize,
    /// Name of an actuator of the surface or library that is kept where it is, in addition to those that are placed. Repeatable; all
    /// others are removed.
    #[arg(long, value_name = "NAME", help_heading = heading::ACTUATORS)]
    pub keep: Vec<String>,
    /// Keep all actuators of the surface.
    #[arg(long, conflicts_with = "keep", help_heading = heading::ACTUATORS)]
    pub keep_all: bool,
    /// Name of the actuator of the surface whose kind and constants the placed ones get; by default its first
    /// one.
    #[arg(long, value_name = "NAME", help_heading = heading::ACTUATORS)]
    pub like: Option<String>,
    #[command(flatten)]
    pub areas: AreaOptions,
    /// Spacing of the grid of places to choose from, in mm; by default a seventh of the shortest wavelength.
    #[arg(long, value_name = "P", allow_negative_numbers = true, help_heading = heading::PLACES)]
    pub grid_mm: Option<f64>,
    /// Least distance between any two actuators, in mm; by default that at which two of those placed would touch.
    #[arg(long, value_name = "D", allow_negative_numbers = true, help_heading = heading::PLACES)]
    pub apart_mm: Option<f64>,
    /// A target in mm, with an optional weight; by default targets are spread evenly over the surface. For a library, the nearest of its
    /// points. Repeatable.
    #[arg(long, value_name = "X,Y[,WEIGHT]", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub at: Vec<String>,
    /// A polygon, such as the screen, in which targets must lie, as its corners in mm; by default anywhere at least one shortest wavelength
    /// from the rim. Repeatable: then in any of them.
    #[arg(long, value_name = "X,Y,X,Y,X,Y...", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub screen: Vec<String>,
    /// How much targets that are spread count by where they are: a CSV file with the columns x_mm, y_mm and weight, of whose points the
    /// nearest one counts. By default all weigh the same.
    #[arg(long, value_name = "FILE.csv", help_heading = heading::TARGETS)]
    pub importance: Option<PathBuf>,
    /// A polygon, as its corners in mm, and a factor on the weights of targets in it; with 0 no target is there. Repeatable.
    #[arg(long, value_name = "X,Y,X,Y,X,Y...:WEIGHT", allow_hyphen_values = true, help_heading = heading::TARGETS)]
    pub important: Vec<String>,
    /// Number of targets that the layout is optimised for, if none are given; layouts are evaluated on three
    /// times as many others.
    #[arg(long, value_name = "N", default_value_t = 20, help_heading = heading::TARGETS)]
    pub targets: usize,
    /// The objective to be maximised, from the contrasts of time reversal at all targets, or from the figures that --by names.
    #[arg(long, value_enum, default_value_t, help_heading = heading::SEARCH)]
    pub objective: ObjectiveName,
    /// For the objective `quantile`: share of the targets that may be worse, in per cent.
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, allow_negative_numbers = true, help_heading = heading::SEARCH)]
    pub share_percent: f64,
    /// Largest error of the actuators' places along each axis, in mm; the layout is optimised for its mean
    /// performance with such errors.
    #[arg(long, value_name = "MM", default_value_t = 0.0, allow_negative_numbers = true, help_heading = heading::SEARCH)]
    pub mounting_mm: f64,
    /// Largest deviation of the tension, up and down, in per cent; the layout is optimised for the mean over
    /// tensions in this range.
    #[arg(long, value_name = "PERCENT", default_value_t = 0.0, allow_negative_numbers = true, help_heading = heading::SEARCH)]
    pub tension_percent: f64,
    /// Window T in ms; by default the one that `design` recommends for evenly spread actuators.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::TIME)]
    pub window_ms: Option<f64>,
    /// Number of random layouts from which the search is restarted, in addition to its start from the greedy
    /// layout.
    #[arg(long, value_name = "N", default_value_t = 10, help_heading = heading::SEARCH)]
    pub restarts: usize,
    /// Seed of the random layouts.
    #[arg(long, value_name = "SEED", default_value_t = 1, help_heading = heading::SEARCH)]
    pub seed: u64,
    /// Largest number of actuators in the table of contrast against their number, at least --count; by default twice that.
    #[arg(long, value_name = "N", help_heading = heading::SEARCH)]
    pub up_to: Option<usize>,
    /// Method of focusing whose drives are evaluated with the surface's own actuators and with the placed
    /// ones. Repeatable.
    #[arg(long, value_enum, help_heading = heading::METHOD)]
    pub method: Vec<MethodName>,
    /// A figure of the drives of the first --method (by default time reversal) by which layouts are compared in a second search, which
    /// begins with the best layouts for the contrast of time reversal. It takes minutes.
    #[arg(long, value_enum, value_name = "FIGURE", help_heading = heading::METHOD)]
    pub by: Option<FigureName>,
    /// Largest number of layouts whose drives are computed and evaluated for --by; by default 6, and 8 for each actuator that is placed, up
    /// to 200.
    #[arg(long, value_name = "N", help_heading = heading::METHOD)]
    pub evaluations: Option<usize>,
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Folder for the surface file with the placed actuators (for a library, the names of the chosen ones), the report and pictures; without
    /// it only the report is printed.
    #[arg(short, long, value_name = "DIR", help_heading = heading::RESULTS)]
    pub output: Option<PathBuf>,
}

impl PlaceOptions {
    /// The areas in which targets count more or less.
    fn important(&self) -> Result<Vec<ImportantAsk>, CliError> {
        let read = each(&self.important, "--important", weighted_polygon)?;
        Ok(read.into_iter().map(|(area_m, weight)| ImportantAsk { area_m, weight }).collect())
    }

    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> Result<Ask, CliError> {
        let (points_m, weights) = of("--at", weighted(&self.at))?;
        Ok(Ask {
            surface: common.surface(&self.surface),
            count: self.count,
            keep: self.keep.clone(),
            keep_all: self.keep_all,
            like: self.like.clone(),
            rim_m: self.areas.rim()?,
            within_m: self.areas.within()?,
            keep_out_m: self.areas.keep_out()?,
            places_m: self.areas.places()?,
            pitch_m: self.grid_mm.map(|mm| mm / 1e3),
            apart_m: self.apart_mm.map(|mm| mm / 1e3),
            points_m,
            weights,
            targets_within_m: each(&self.screen, "--screen", polygon)?,
            importance: self.importance.clone(),
            important: self.important()?,
            targets: self.targets,
            objective: self.objective.into(),
            share: self.share_percent / 100.0,
            mounting_m: self.mounting_mm / 1e3,
            tension: self.tension_percent / 100.0,
            window_s: seconds(self.window_ms, "--window-ms")?,
            restarts: self.restarts,
            seed: self.seed,
            up_to: self.up_to,
            methods: self.method.iter().copied().map(Into::into).collect(),
            by: self.by.map(Into::into),
            evaluations: self.evaluations,
            output: self.output.clone(),
            no_figures: self.figures.no_figures,
            columns: self.figures.columns,
        })
    }
}
