//! Options of the task `focus`.

use crate::record::{Request, Visit};
use crate::target::{LevelAsk, PointAsk, ShapeAsk};
use crate::{Place, SurfaceAsk, TaskError, names};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple::focus::{Method, Options};
use unripple_calibrate::Interpolation;

/// Compensation of the waves' decay in the drive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Losses {
    /// No compensation: the paper's time reversal.
    #[default]
    None,
    /// Responses are multiplied by e^{+t/τ}, where τ is the single decay time of the surface.
    Uniform,
    /// Each mode's response is multiplied by e^{+t/τ}, where τ is the decay time of that mode.
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
    /// Level to which the drive is scaled.
    pub level: LevelAsk,
    /// Focusing method by which the drive is computed.
    #[serde(with = "names::method")]
    pub method: Method,
    /// Weight of the velocity to be minimised against the drive's energy, from 0 (time reversal) to 1
    /// (velocity alone); by default a value that depends on the method.
    pub strength: Option<f64>,
    /// For `limited`: peak velocity to reach at the targets, from that of the unconstrained drive scaled to
    /// the limit (0) to that of the one-bit drive (1).
    pub push: f64,
    /// Largest rms of all actuators together, √(Σ mean d²) of their drives d, in the drive's unit.
    pub total_rms: Option<f64>,
    /// For `robust`: relative shift of all natural frequencies, up and down, that the drive must tolerate.
    pub spread: f64,
    /// For `felt`: balance of what is minimised outside the targets, from the mean square of what is felt
    /// (0) to the square of its largest value (1).
    pub worst: Option<f64>,
    /// For `felt`: weight of the drive's energy in the objective.
    pub economy: Option<f64>,
    /// For `inverse`: minimise the displacements of the modes at the focal instant as well as their
    /// velocities.
    pub rest: bool,
    /// Window T in s; by default the one that `design` recommends.
    pub window_s: Option<f64>,
    /// How responses are interpolated for a target between the points of a library.
    #[serde(with = "names::interpolation")]
    pub between: Interpolation,
    /// Compensation of the waves' decay in the drive.
    pub losses: Losses,
    /// Length of a repeated drive in s; by default long enough for a periodic steady state.
    pub duration_s: Option<f64>,
    /// Places in m where fingers rest on the surface while the drive is evaluated; the drive is computed
    /// without them, unless `finger_aware` is set.
    pub fingers_m: Vec<Place>,
    /// Compute the drive for the surface with the fingers of `fingers_m` resting on it.
    pub finger_aware: bool,
    /// For `robust`: relative error of the tension, up and down, that the drive must tolerate.
    pub bear_tension: Option<f64>,
    /// For `robust`: places in m of fingers whose presence or absence the drive must tolerate.
    pub bear_fingers_m: Vec<Place>,
    /// Evaluate the drive on this surface instead of the surface or library that it was computed for.
    pub on: Option<SurfaceAsk>,
    /// Evaluate the drive with modes up to this frequency, in Hz; by default up to twice the top of the band, at most 0.45 of the
    /// sample rate.
    pub judge_hz: Option<f64>,
    /// Height above the middle of the surface, in m, at which the sound pressure level is computed; by default
    /// 0.3.
    pub listen_m: Option<f64>,
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
            listen_m: None,
            output: None,
            no_figures: false,
            columns: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "focus";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        std::iter::once(&mut self.surface).chain(&mut self.on).collect()
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.shapes.iter_mut().filter_map(ShapeAsk::file).try_for_each(visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}
