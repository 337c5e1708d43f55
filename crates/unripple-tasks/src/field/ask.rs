//! Options of the task `field`.

use crate::record::{Request, Visit};
use crate::{Place, SurfaceAsk, TaskError, names};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple_calibrate::Interpolation;

/// A drive, from a file or as samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum DriveAsk {
    /// A WAV file with one channel per actuator, in the actuators' units.
    File(PathBuf),
    /// Samples that the request itself contains.
    Samples {
        /// Samples of the drive: one list per actuator, in the actuators' units.
        channels: Vec<Vec<f64>>,
        /// Sample rate of the drive, in Hz.
        rate_hz: f64,
    },
}

impl Default for DriveAsk {
    fn default() -> Self {
        Self::File("drive.wav".into())
    }
}

/// Request to evaluate a drive on a surface: which drive and surface, and at which points and instants.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses.
    pub surface: SurfaceAsk,
    /// The drive that is played.
    pub drive: DriveAsk,
    /// Points at which the motion is evaluated, in m; by default the point with the largest peak velocity.
    pub points_m: Vec<Place>,
    /// Instants at which the motion is evaluated, in s: one for all points, or one per point; by default
    /// the instant of each point's largest velocity.
    pub instants_s: Vec<f64>,
    /// Places in m where fingers rest on the surface; their mechanical properties are those in the surface
    /// file.
    pub fingers_m: Vec<Place>,
    /// Period of a repeated drive, in s: the drive is then evaluated over its last full period.
    pub period_s: Option<f64>,
    /// Compute the field with modes up to this frequency, in Hz; by default up to twice the top of the band, at most 0.45 of the
    /// sample rate.
    pub judge_hz: Option<f64>,
    /// Height above the middle of the surface, in m, at which the sound pressure level is computed; by default
    /// 0.3.
    pub listen_m: Option<f64>,
    /// Folder for the report, snapshot, map of peaks and animation; by default no file is written.
    pub output: Option<PathBuf>,
    /// Write no figures and no animation.
    pub no_figures: bool,
    /// Width of all figures in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default each figure
    /// has its own width.
    pub columns: Option<usize>,
    /// Start and end of the animation in s; by default from 6 ms before the instant at the first point to 3
    /// ms after it.
    pub movie_s: Option<[f64; 2]>,
    /// Number of frames of the animation, at most 5000; 0 for no animation.
    pub frames: usize,
    /// How responses are interpolated for a place between the points of a library.
    #[serde(with = "names::interpolation")]
    pub between: Interpolation,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            drive: DriveAsk::default(),
            points_m: Vec::new(),
            instants_s: Vec::new(),
            fingers_m: Vec::new(),
            period_s: None,
            judge_hz: None,
            listen_m: None,
            output: None,
            no_figures: false,
            columns: None,
            movie_s: None,
            frames: 60,
            between: Interpolation::default(),
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "field";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        match &mut self.drive {
            DriveAsk::File(file) => visit(file),
            DriveAsk::Samples { .. } => Ok(()),
        }
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
