//! Options of the task `focus`.

use crate::target::{LevelAsk, PointAsk, ShapeAsk};
use crate::{Place, SurfaceAsk, names, source};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple::focus::{Method, Options};
use unripple_calibrate::Interpolation;

/// How the decay of what is played back is made up for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Losses {
    /// Not at all: the paper's time reversal.
    #[default]
    None,
    /// By e^{+t/τ} with the surface's one decay time.
    Uniform,
    /// Mode by mode, by e^{+t/τ} with each mode's own decay time.
    PerMode,
}

/// Where to focus, by which method, and the surface that the drive is evaluated on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses.
    pub surface: SurfaceAsk,
    /// Points to be in focus.
    pub points: Vec<PointAsk>,
    /// Shapes to be in focus.
    pub shapes: Vec<ShapeAsk>,
    /// How strong the drive is to be.
    pub level: LevelAsk,
    /// How to focus.
    #[serde(with = "names::method")]
    pub method: Method,
    /// How far from time reversal (0) to the method's own limit (1).
    pub strength: Option<f64>,
    /// For `limited`: the level at the limit, from that of the unlimited drive (0) to that of one-bit (1).
    pub push: f64,
    /// Largest rms of all actuators together, in the drive's unit.
    pub total_rms: Option<f64>,
    /// For `robust`: the stretch of frequencies, up and down, that the drive must stand, as a share.
    pub spread: f64,
    /// For `felt`: from the mean of what is felt elsewhere (0) to its worst spot (1).
    pub worst: Option<f64>,
    /// For `felt`: weight of the drive's energy.
    pub economy: Option<f64>,
    /// For `inverse`: bring displacements to zero as well.
    pub rest: bool,
    /// Window T in s; by default the one that `design` recommends.
    pub window_s: Option<f64>,
    /// What stands for a target between the points of a library.
    #[serde(with = "names::interpolation")]
    pub between: Interpolation,
    /// Make up for losses in what is played back.
    pub losses: Losses,
    /// Length of a repeated drive in s; by default long enough to be steady.
    pub duration_s: Option<f64>,
    /// Fingers that rest on the surface while the drive is judged, in m: the drive is what it would be without.
    pub fingers_m: Vec<Place>,
    /// Make the drive for the surface under those fingers.
    pub finger_aware: bool,
    /// For `robust`: bear a tension off by this share, up and down.
    pub bear_tension: Option<f64>,
    /// For `robust`: bear fingers that may be there or not, in m.
    pub bear_fingers_m: Vec<Place>,
    /// Judge the drive on another surface than the one, or than the library, it was computed for.
    pub on: Option<SurfaceAsk>,
    /// Judge on modes up to this frequency, in Hz; by default those of the band.
    pub judge_hz: Option<f64>,
    /// Folder for drive.wav, report.json, report.md and figures. An earlier run's folder is replaced whole, unless something else is in it.
    pub output: Option<PathBuf>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            points: Vec::new(),
            shapes: Vec::new(),
            level: LevelAsk::default(),
            method: Method::default(),
            strength: None,
            push: Options::default().push,
            total_rms: None,
            spread: Options::default().spread,
            worst: None,
            economy: None,
            rest: false,
            window_s: None,
            between: Interpolation::default(),
            losses: Losses::default(),
            duration_s: None,
            fingers_m: Vec::new(),
            finger_aware: false,
            bear_tension: None,
            bear_fingers_m: Vec::new(),
            on: None,
            judge_hz: None,
            output: None,
        }
    }
}

impl Ask {
    /// Files and folders that are read, which no output may take the place of.
    pub fn reads(&self) -> Vec<PathBuf> {
        let surfaces = std::iter::once(&self.surface).chain(&self.on);
        let drawings = self.shapes.iter().filter_map(ShapeAsk::reads).cloned();
        surfaces.flat_map(source::reads).chain(drawings).collect()
    }
}
