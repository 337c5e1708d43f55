//! Options of the task `fit`.

use crate::record::{Request, Visit};
use crate::{Place, TaskError};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Request to fit the model to a library: which library, which parameters, and where responses of the
/// fitted model are computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A library that `calibrate` measured with sensors at the actuators: its last points hold the responses between
    /// actuators.
    pub library: PathBuf,
    /// Spacing of a square grid of points where responses of the fitted model are computed, in m.
    pub pitch_m: Option<f64>,
    /// Single points where responses of the fitted model are computed, in m.
    pub points_m: Vec<Place>,
    /// Largest number of stray masses to fit: point masses on the sheet that the surface file does not
    /// contain.
    pub strays: usize,
    /// Largest number of half waves, both directions together, in the variation of tension over the sheet; 0 for
    /// uniform tension.
    pub profile: usize,
    /// Write the library even if the fitted model is doubtful; the library is then marked, and tasks that
    /// use it warn.
    pub even_if_doubtful: bool,
    /// Relative accuracy of the modes' frequencies; by default that of the surface that the library describes, or 1e-6.
    pub accuracy: Option<f64>,
    /// Library to write, with responses of the fitted model, corrected by measured responses near their
    /// points. Needs `pitch_m` or `points_m`.
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
            accuracy: None,
            output: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "fit";

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        visit(&mut self.library)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
