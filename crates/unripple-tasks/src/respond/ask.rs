//! Options of the task `respond`.

use crate::SurfaceAsk;
use crate::record::Request;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which responses to compute, and where to store them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// Spacing of the square grid of points, in m. Points lie at multiples of the spacing along both axes;
    /// those within a quarter of it from the rim are left out.
    pub pitch_m: f64,
    /// Length of the responses in s, at most 60; by default twice the window that `design` recommends.
    pub length_s: Option<f64>,
    /// Folder of the library to write. An unfinished library with the same points and settings is
    /// continued.
    pub output: PathBuf,
}

impl Request for Ask {
    const COMMAND: &'static str = "respond";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output.unwrap_or_default();
    }
}
