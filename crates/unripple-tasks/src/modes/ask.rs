//! Options of the task `modes`.

use crate::SurfaceAsk;
use crate::record::Request;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which modes to compute, and how accurately.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// Highest frequency of the modes, in Hz; by default the top of the surface's band.
    pub top_hz: Option<f64>,
    /// Relative accuracy of the modes' frequencies; by default that of the surface's file, or 1e-6.
    pub accuracy: Option<f64>,
}

impl Request for Ask {
    const COMMAND: &'static str = "modes";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, _output: Option<PathBuf>) {}
}
