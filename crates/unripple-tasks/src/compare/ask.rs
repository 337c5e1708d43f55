//! Options of the task `compare`.

use crate::record::{Request, Visit};
use crate::target::{LevelAsk, PointAsk, ShapeAsk};
use crate::{SurfaceAsk, TaskError};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Where every method is to focus, and how strongly.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// Points to be in focus.
    pub points: Vec<PointAsk>,
    /// Shapes to be in focus.
    pub shapes: Vec<ShapeAsk>,
    /// How strong each drive is to be.
    pub level: LevelAsk,
    /// Window T in s; by default the one that `design` recommends.
    pub window_s: Option<f64>,
    /// Evaluate drives on modes up to this frequency, in Hz; by default up to twice the top of the band.
    pub judge_hz: Option<f64>,
    /// Leave out the tradeoffs of each method's parameter, which take half of the time, and the figure that shows them.
    pub no_tradeoffs: bool,
    /// Write no figure.
    pub no_figures: bool,
    /// Columns of a page that the figure is as wide as: 1 (86 mm) or 2 (178 mm); by default 2.
    pub columns: Option<usize>,
    /// Folder for the report and figure; by default no file is written.
    pub output: Option<PathBuf>,
}

impl Request for Ask {
    const COMMAND: &'static str = "compare";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.shapes.iter_mut().filter_map(ShapeAsk::file).try_for_each(visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
