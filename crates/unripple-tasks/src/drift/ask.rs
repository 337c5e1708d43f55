//! Options of the task `drift`.

use crate::record::Request;
use crate::{DeviceAsk, SurfaceAsk};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The surface whose tension is measured, the device, and the duration of the measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library that `calibrate` measured with sensors at the actuators. For a library
    /// that `fit` wrote, the measured library that it was fitted to is used.
    pub surface: SurfaceAsk,
    /// The device that plays and records.
    pub device: DeviceAsk,
    /// Duration of the sequence of pings, in s.
    pub seconds: f64,
    /// Largest relative change of tension that is searched for, up and down (0.08 for 8 %).
    pub range: f64,
    /// For the virtual surface: relative deviation of the simulated tension from that in the surface file.
    pub changed: f64,
    /// For the virtual surface: relative change of the simulated tension per minute, from shortly before
    /// the first ping on.
    pub changing_per_min: f64,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            device: DeviceAsk::default(),
            seconds: 4.0,
            range: 0.08,
            changed: 0.0,
            changing_per_min: 0.0,
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "drift";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, _output: Option<PathBuf>) {}
}
