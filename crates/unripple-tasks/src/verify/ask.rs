//! Options of the task `verify`.

use crate::field::DriveAsk;
use crate::record::{Request, Visit};
use crate::{DeviceAsk, Place, SurfaceAsk, TaskError, names};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple_calibrate::Interpolation;

/// Request to play a drive and compare what a probe records with the prediction: the drive, what it was made for, the device, the places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses: what the drive was made for.
    pub surface: SurfaceAsk,
    /// The drive that is played.
    pub drive: DriveAsk,
    /// The device that plays and records.
    pub device: DeviceAsk,
    /// Place at which the drive focuses, in m; by default that of the first target in `report.json` beside the drive.
    pub target_m: Option<Place>,
    /// Instant of the focus, in s from the drive's first sample; by default that in `report.json` beside the drive, else that of the
    /// largest predicted velocity at the target.
    pub instant_s: Option<f64>,
    /// Places at which the probe records besides the target, in m; by default some outside the focal disc.
    pub probes_m: Vec<Place>,
    /// Number of places outside the focal disc that are chosen if none is given, at most 64.
    pub probe_count: usize,
    /// Level at which the drive is played, as a share of the drive as it is.
    pub level: f64,
    /// Velocity that the probe's input at full scale stands for, in m/s, negative for a reversed probe; without it velocities are only
    /// compared with each other.
    pub probe_scale: Option<f64>,
    /// Pairs of the name of an actuator or of the probe and the name of its channel, where the two names differ.
    pub wires: Vec<(String, String)>,
    /// Predict with modes up to this frequency, in Hz; by default up to twice the top of the band, at most 0.45 of the sample rate.
    pub judge_hz: Option<f64>,
    /// How responses are interpolated for a place between the points of a library.
    #[serde(with = "names::interpolation")]
    pub between: Interpolation,
    /// Only say what would be played, and how loud; no device is opened.
    pub dry_run: bool,
    /// For the virtual surface: relative deviation of the simulated tension from that in the surface file.
    pub changed: f64,
    /// For the virtual surface: pairs of the names of actuators whose wires are exchanged.
    pub swapped: Vec<(String, String)>,
    /// For the virtual surface: magnitude at which its amplifiers clip, as a share of the largest of the drive.
    pub clipped: Option<f64>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            drive: DriveAsk::default(),
            device: DeviceAsk::default(),
            target_m: None,
            instant_s: None,
            probes_m: Vec::new(),
            probe_count: 8,
            level: 1.0,
            probe_scale: None,
            wires: Vec::new(),
            judge_hz: None,
            between: Interpolation::default(),
            dry_run: false,
            changed: 0.0,
            swapped: Vec::new(),
            clipped: None,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "verify";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        match &mut self.drive {
            DriveAsk::File(file) => visit(file),
            DriveAsk::Samples { .. } => Ok(()),
        }
    }

    fn send_to(&mut self, _output: Option<PathBuf>) {}
}
