//! Options of the task `compare`.

use crate::target::{LevelAsk, PointAsk, ShapeAsk};
use crate::{SurfaceAsk, source};
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
    /// Judge on modes up to this frequency, in Hz; by default to twice the band.
    pub judge_hz: Option<f64>,
    /// Folder for the report and figure; without it the table alone is made.
    pub output: Option<PathBuf>,
}

impl Ask {
    /// Files and folders that are read, which no output may take the place of.
    pub fn reads(&self) -> Vec<PathBuf> {
        let drawings = self.shapes.iter().filter_map(ShapeAsk::reads).cloned();
        source::reads(&self.surface).into_iter().chain(drawings).collect()
    }
}
