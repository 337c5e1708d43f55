//! Options of the task `respond`.

use crate::SurfaceAsk;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which responses are wanted, and where they are to be kept.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// Distance between points, in m: they lie at its multiples, those near the rim left out.
    pub pitch_m: f64,
    /// Length of the responses in s; by default twice the window that `design` recommends.
    pub length_s: Option<f64>,
    /// Folder of the library. A library of the same plan is continued where it was left.
    pub output: PathBuf,
}
