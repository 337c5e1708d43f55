//! Options of the task `place`.

use crate::record::{Request, Visit};
use crate::{Place, SurfaceAsk, TaskError, names};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple::focus::Method;
use unripple_placement::Objective;

/// Number of targets on which layouts are evaluated, for each target that they are optimised for.
pub(super) const TESTED: usize = 3;

/// Request to place actuators: their number and kind, where they may be, and the objective.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses, of whose actuators some are chosen.
    pub surface: SurfaceAsk,
    /// Number of actuators to place, or to choose.
    pub count: usize,
    /// Names of actuators of the surface or library that are kept where they are, in addition to those that are placed; all others are
    /// removed.
    pub keep: Vec<String>,
    /// Keep all actuators of the surface.
    pub keep_all: bool,
    /// Name of the actuator of the surface whose kind and constants the placed ones get; by default its first
    /// actuator.
    pub like: Option<String>,
    /// Least and greatest distance of the places from the rim, in m; by default anywhere.
    pub rim_m: Option<[f64; 2]>,
    /// Polygons in one of which places must lie, each as its corners in m; by default the whole surface.
    pub within_m: Vec<Vec<Place>>,
    /// Polygons into which no actuator may reach with its contact disc or patch, each as its corners in m.
    pub keep_out_m: Vec<Vec<Place>>,
    /// Places to choose from, in m, instead of those of a grid.
    pub places_m: Vec<Place>,
    /// Spacing of the grid of places to choose from, in m; by default a seventh of the shortest wavelength.
    pub pitch_m: Option<f64>,
    /// Least distance between any two actuators, in m; by default that at which two of those placed would touch.
    pub apart_m: Option<f64>,
    /// Targets, in m; by default spread evenly over the surface. Of a library they are points that it has.
    pub points_m: Vec<Place>,
    /// Weight of each target; by default all weigh the same.
    pub weights: Vec<f64>,
    /// Polygons, such as the screen, in one of which targets must lie, each as its corners in m; by default anywhere at least one shortest
    /// wavelength from the rim.
    pub targets_within_m: Vec<Vec<Place>>,
    /// How much targets that are spread over the surface count by where they are: a CSV file with the columns `x_mm`, `y_mm` and `weight`,
    /// of whose points the nearest one counts. By default all weigh the same.
    pub importance: Option<PathBuf>,
    /// Areas in which targets count more or less: the weight of a target is multiplied by those of all areas that it is in.
    pub important: Vec<ImportantAsk>,
    /// Number of targets that the layout is optimised for, if none are given; layouts are evaluated on three
    /// times as many others.
    pub targets: usize,
    /// The objective that is maximised.
    pub objective: ObjectiveAsk,
    /// For the objective `quantile`: share of the targets that may be worse, 0 to 1.
    pub share: f64,
    /// Largest error of the actuators' places along each axis, in m; layouts are optimised for their mean
    /// performance with such errors.
    pub mounting_m: f64,
    /// Largest relative deviation of the tension, up and down; layouts are optimised for the mean over
    /// tensions in this range.
    pub tension: f64,
    /// Window T in s; by default the one that `design` recommends for evenly spread actuators.
    pub window_s: Option<f64>,
    /// Number of random layouts from which the search is restarted, in addition to its start from the greedy
    /// layout.
    pub restarts: usize,
    /// Seed of the random layouts.
    pub seed: u64,
    /// Largest number of actuators of the curve of contrast against their number; by default twice `count`.
    pub up_to: Option<usize>,
    /// Methods of focusing whose drives are evaluated before and after. With `by`, the layout is optimised for drives of the first one.
    #[serde(with = "names::methods")]
    pub methods: Vec<Method>,
    /// A figure of the drives of the first of `methods` (or of time reversal) by which layouts are compared in a second search, which
    /// begins with the best ones for the contrast of time reversal; by default there is none.
    pub by: Option<ByAsk>,
    /// Largest number of layouts whose drives are computed and evaluated in that search; by default 6, and 8 for each actuator that is
    /// placed, up to 200.
    pub evaluations: Option<usize>,
    /// Folder for the placed surface (of a library, the names of the chosen actuators), report and figures; by default no file is written.
    pub output: Option<PathBuf>,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of all figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure
    /// has its own width.
    pub columns: Option<usize>,
}

/// An area, and how much the targets in it count.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportantAsk {
    /// The corners of the area, in m.
    pub area_m: Vec<Place>,
    /// Factor on the weights of targets inside it, from 0: with 0, no target is there.
    pub weight: f64,
}

/// The objective that is maximised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ObjectiveAsk {
    /// The mean of the contrasts at all targets.
    #[default]
    Mean,
    /// The least contrast.
    Worst,
    /// The contrast that a share of the targets stays below.
    Quantile,
}

/// A figure of a drive, by which layouts are compared: those of the results by method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ByAsk {
    /// Contrast at the focal instant; the larger, the better.
    Contrast,
    /// Felt contrast; the larger, the better.
    FeltContrast,
    /// Felt level at the target with the drive at its limit; the larger, the better.
    FeltLevel,
    /// Energy of the drive for a peak velocity; the smaller, the better.
    EnergyForPeak,
}

impl Ask {
    /// The objective that is maximised.
    pub(super) fn objective(&self) -> Objective {
        match self.objective {
            ObjectiveAsk::Mean => Objective::Mean,
            ObjectiveAsk::Worst => Objective::Worst,
            ObjectiveAsk::Quantile => Objective::Quantile(self.share),
        }
    }
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            count: 8,
            keep: Vec::new(),
            keep_all: false,
            like: None,
            rim_m: None,
            within_m: Vec::new(),
            keep_out_m: Vec::new(),
            places_m: Vec::new(),
            pitch_m: None,
            apart_m: None,
            points_m: Vec::new(),
            weights: Vec::new(),
            targets_within_m: Vec::new(),
            importance: None,
            important: Vec::new(),
            targets: 20,
            objective: ObjectiveAsk::Mean,
            share: 0.1,
            mounting_m: 0.0,
            tension: 0.0,
            window_s: None,
            restarts: 10,
            seed: 1,
            up_to: None,
            methods: Vec::new(),
            by: None,
            evaluations: None,
            output: None,
            no_figures: false,
            columns: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "place";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.importance.as_mut().map_or(Ok(()), visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
