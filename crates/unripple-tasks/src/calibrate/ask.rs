//! Options of the task `calibrate`.

use crate::record::{Request, Visit};
use crate::{DeviceAsk, Place, SurfaceAsk, TaskError};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// How the responses at a point are measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum By {
    /// With a vibrometer, accelerometer or microphone at the place, while actuators drive.
    #[default]
    Probe,
    /// With taps at the place, while the actuators' sensors record.
    Tap,
    /// With blows of a hammer at the place, whose force is recorded beside the actuators' sensors.
    Hammer,
}

/// Scales of the inputs: the value that a sample at full scale (1) stands for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct InputScales {
    /// Scale of all inputs that are not in `named`.
    pub all: Option<f64>,
    /// Scales by the names of inputs, in m/s for the probe and in the sensor's unit for actuators; negative
    /// for an input of reversed polarity.
    pub named: BTreeMap<String, f64>,
}

/// Request to measure responses: what is measured, through which device, and in which library it is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface: what is known of the surface before the measurement.
    pub surface: SurfaceAsk,
    /// The device that plays and records.
    pub device: DeviceAsk,
    /// Spacing of a square grid of points to measure, in m.
    pub pitch_m: Option<f64>,
    /// Single points to measure, in m.
    pub points_m: Vec<Place>,
    /// How points are measured.
    pub by: By,
    /// Number of recordings of each point, which are averaged, or number of taps: 1 to 99.
    pub repeats: usize,
    /// Length of an actuator's sweep, in s; by default 0.5, or longer for a surface with a long decay time.
    pub sweep_s: Option<f64>,
    /// Length of each stored response, in s, at most 60; by default 0.1, or longer for a surface with a long decay time.
    pub response_s: Option<f64>,
    /// Level of the sweeps, as a share of the surface's drive limit.
    pub level: f64,
    /// Pairs of the name of an actuator, sensor, probe or reference and the name of its channel, where the
    /// two names differ.
    pub wires: Vec<(String, String)>,
    /// Scales of the inputs. Without them absolute levels are unknown.
    pub input_scales: InputScales,
    /// Names of actuators to leave out, for example because they are dead.
    pub without: Vec<String>,
    /// Delay of the probe relative to the sensors, in s, such as that of a vibrometer's decoder; by default it is estimated.
    pub probe_delay_s: Option<f64>,
    /// For recordings of taps or blows made elsewhere (tape): table (CSV) of the columns `file`, `x_mm` and `y_mm`, which says where each file
    /// was recorded; by default the files are `point-001.wav` and so on.
    pub table: Option<PathBuf>,
    /// Skip all comparisons with a model, for a surface that the model cannot describe, such as a whole
    /// phone or a sheet with ribs.
    pub no_model: bool,
    /// For recordings made elsewhere (tape): resample those whose sample rate differs from that of the
    /// surface.
    pub resample: bool,
    /// Only check levels: one short recording shows which channels are too loud or too quiet, and what to
    /// do about it.
    pub check_levels: bool,
    /// Continue although the wiring test finds a fault.
    pub any_wiring: bool,
    /// Folder for a figure: signal-to-noise ratio and coherence over frequency, and which point is bad in
    /// which band. An existing folder is replaced only if it holds nothing but the unchanged files of an
    /// earlier run.
    pub figure: Option<PathBuf>,
    /// Folder of the library: a new one, or that of an unfinished run with the same options.
    pub output: PathBuf,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            device: DeviceAsk::default(),
            pitch_m: None,
            points_m: Vec::new(),
            by: By::Probe,
            repeats: 1,
            sweep_s: None,
            response_s: None,
            level: 1.0,
            wires: Vec::new(),
            input_scales: InputScales::default(),
            without: Vec::new(),
            probe_delay_s: None,
            table: None,
            no_model: false,
            resample: false,
            check_levels: false,
            any_wiring: false,
            figure: None,
            output: PathBuf::new(),
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "calibrate";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.table.iter_mut().try_for_each(visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output.unwrap_or_default();
        self.figure = None;
    }
}
