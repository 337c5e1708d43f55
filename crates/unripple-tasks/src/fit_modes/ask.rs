//! Options of the task `fit_modes`.

use crate::SurfaceAsk;
use crate::record::Request;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which surface to fit to which frequencies, and which of its quantities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// The measured modes, in any order.
    pub modes: Vec<ModeAsk>,
    /// Names of the quantities to fit; if empty, those that are usual for the surface.
    pub free: Vec<String>,
    /// Relative standard deviation of the frequencies, and of the model.
    pub error: f64,
    /// Whether it is certain which side is held in which way; if not, other arrangements are tried.
    pub sides_known: bool,
    /// Folder for the report, the fitted surface file and figures; by default no file is written.
    pub output: Option<PathBuf>,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of all figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure has its own width.
    pub columns: Option<usize>,
}

/// A measured mode.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModeAsk {
    /// Natural frequency, in Hz.
    pub frequency_hz: f64,
    /// Decay time in s, in which the amplitude falls to 1/e, if it was measured.
    #[serde(default)]
    pub decay_time_s: Option<f64>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            modes: Vec::new(),
            free: Vec::new(),
            error: 0.01,
            sides_known: false,
            output: None,
            no_figures: false,
            columns: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "fit_modes";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
