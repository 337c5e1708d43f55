//! Options of the task `stroke`.

use crate::record::{Request, Visit};
use crate::target::{LineAsk, ShapeAsk};
use crate::{SurfaceAsk, TaskError};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The path of a moving focus, its speed and level, and the surface that the drive is evaluated on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// Path of the focus; for a filled shape, the path is its outline.
    pub path: ShapeAsk,
    /// How fast the focus moves, in m/s.
    pub speed_m_s: f64,
    /// Velocity of the sheet at each pulse along the path, in m/s.
    pub level_m_s: f64,
    /// Window T: time from the drive's first sample to the earliest possible focal instant, in s.
    pub window_s: Option<f64>,
    /// Evaluate the drive on this surface instead of the one that it was computed for.
    pub on: Option<SurfaceAsk>,
    /// Evaluate the drive with modes up to this frequency, in Hz; by default up to twice the top of the band, at most
    /// 0.45 of the sample rate.
    pub judge_hz: Option<f64>,
    /// Folder for drive.wav, report.json, report.md and figures. An existing folder is replaced only if it
    /// holds nothing but the unchanged files of an earlier run.
    pub output: Option<PathBuf>,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of all figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure
    /// has its own width.
    pub columns: Option<usize>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            path: ShapeAsk::Lines { lines: vec![LineAsk::default()], filled: false },
            speed_m_s: 0.1,
            level_m_s: 10e-3,
            window_s: None,
            on: None,
            judge_hz: None,
            output: None,
            no_figures: false,
            columns: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "stroke";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        std::iter::once(&mut self.surface).chain(&mut self.on).collect()
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.path.file().map_or(Ok(()), visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
