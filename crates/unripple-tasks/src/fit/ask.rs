//! Options of the task `fit`.

use crate::Place;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which library the model is fitted to, what may be found, and where its responses are wanted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A library that `calibrate` made on a device whose actuators listen: its last points are their responses at
    /// each other.
    pub library: PathBuf,
    /// Distance of the points of a square grid where responses of the fitted model are wanted, in m.
    pub pitch_m: Option<f64>,
    /// Single points where they are wanted, in m.
    pub points_m: Vec<Place>,
    /// Stray masses that may be found.
    pub strays: usize,
    /// Half waves that the tension's profile over the sheet may have; 0 for an even tension.
    pub profile: usize,
    /// Write the library even if the model is doubtful; it says so then, and tasks that use it warn.
    pub even_if_doubtful: bool,
    /// Library of the fitted model's responses, blended with what was measured at points nearby. Needs points.
    pub output: Option<PathBuf>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            library: PathBuf::new(),
            pitch_m: None,
            points_m: Vec::new(),
            strays: 3,
            profile: 3,
            even_if_doubtful: false,
            output: None,
        }
    }
}
