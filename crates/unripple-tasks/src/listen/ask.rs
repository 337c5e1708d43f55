//! Options of the task `listen`.

use crate::TaskError;
use crate::record::{Request, Visit};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which recording to listen to, and what for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A WAV file with the sound or the motion of a surface that was knocked on.
    pub recording: PathBuf,
    /// Channel of the file, from 1; by default the loudest.
    pub channel: Option<usize>,
    /// Lowest and highest frequency in Hz; by default 20 to 5000, but no more than four tenths of the sample rate.
    pub band_hz: Option<[f64; 2]>,
    /// Frequency of the mains in Hz; by default 50 or 60, whichever is heard.
    pub mains_hz: Option<f64>,
    /// Number of the hit to listen to, from 1; by default the last.
    pub hit: Option<usize>,
    /// Largest number of modes, the strongest ones.
    pub most: usize,
    /// Least level of a mode relative to the strongest, in dB.
    pub least_db: f64,
    /// Folder for report and figures; by default no file is written.
    pub output: Option<PathBuf>,
    /// Write no figures.
    pub no_figures: bool,
    /// Width of all figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure has its own width.
    pub columns: Option<usize>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            recording: PathBuf::new(),
            channel: None,
            band_hz: None,
            mains_hz: None,
            hit: None,
            most: 30,
            least_db: -60.0,
            output: None,
            no_figures: false,
            columns: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "listen";

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        visit(&mut self.recording)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
