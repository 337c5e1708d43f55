//! Options of the task `calibrate`.

use crate::{DeviceAsk, Place, SurfaceAsk};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// How a place is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum By {
    /// A vibrometer, accelerometer or microphone at the place, actuators driving.
    #[default]
    Probe,
    /// Taps at the place, actuators listening.
    Tap,
}

/// What inputs at full scale stand for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct InputScales {
    /// Scale of all inputs that are not named.
    pub all: Option<f64>,
    /// Scales by the inputs' names: m/s for the probe, the sensors' unit for actuators; below 0 where an input is
    /// reversed.
    pub named: BTreeMap<String, f64>,
}

/// What is to be measured, through what, and where it is to be kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface: what is known of the surface beforehand.
    pub surface: SurfaceAsk,
    /// What plays and listens.
    pub device: DeviceAsk,
    /// Distance of the points of a square grid, in m.
    pub pitch_m: Option<f64>,
    /// Single points, in m.
    pub points_m: Vec<Place>,
    /// How points are measured.
    pub by: By,
    /// Recordings of each point, averaged; taps of each point.
    pub repeats: usize,
    /// Length of an actuator's sweep, in s; by default 0.5, or more as long as the surface rings.
    pub sweep_s: Option<f64>,
    /// Length of each response that is kept, in s; by default 0.1, or more as long as the surface rings.
    pub response_s: Option<f64>,
    /// Drive, as a share of the surface's limit.
    pub level: f64,
    /// Channels where they are not named as the actuator, sensor, probe or reference: the name, and the channel.
    pub wires: Vec<(String, String)>,
    /// What inputs at full scale stand for. Without it levels are not known.
    pub input_scales: InputScales,
    /// Actuators that are to be left out, since they are dead.
    pub without: Vec<String>,
    /// Time by which the probe's signal is later than the sensors', in s: a vibrometer's decoder; by default it is found.
    pub probe_delay_s: Option<f64>,
    /// Compare nothing with a model: for a surface that no model fits, such as a whole phone or a sheet with ribs.
    pub no_model: bool,
    /// Tape: bring recordings of another rate to that of the surface.
    pub resample: bool,
    /// Listen to levels only: a short take that says what is too loud or too quiet, and what to do.
    pub check_levels: bool,
    /// Go on although the wiring test finds a fault.
    pub any_wiring: bool,
    /// Folder for a figure: signal to noise and coherence over frequency, and which point is bad in which band. An earlier run's folder is
    /// replaced whole, unless something else is in it.
    pub figure: Option<PathBuf>,
    /// The library: a new folder, or one that a run like this one was filling.
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
            no_model: false,
            resample: false,
            check_levels: false,
            any_wiring: false,
            figure: None,
            output: PathBuf::new(),
        }
    }
}
