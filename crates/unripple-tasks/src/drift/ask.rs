//! What `drift` is asked.

use crate::{DeviceAsk, SurfaceAsk, source};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Which surface is listened to through which device, and for how long.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library that `calibrate` measured with actuators that listen; of one that
    /// `fit` wrote, the library that it was fitted to is followed.
    pub surface: SurfaceAsk,
    /// What plays and listens.
    pub device: DeviceAsk,
    /// Seconds of pings.
    pub seconds: f64,
    /// Largest change of tension that is looked for, as a share, up and down.
    pub range: f64,
    /// Virtual: by what share the tension of the true surface is another.
    pub changed: f64,
    /// Virtual: by what share it changes in a minute, beginning with the pings.
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

impl Ask {
    /// Files and folders that are read.
    pub fn reads(&self) -> Vec<PathBuf> {
        source::reads(&self.surface)
    }
}
