//! The modes of a surface with its actuators on it, counted: masses, springs, coils and electrical loads.

use crate::SurfaceModes;
use serde::Serialize;
use std::f64::consts::TAU;
use unripple_core::Surface;

/// Mode count, first natural frequency and decay time of the sheet with its actuators attached.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WithActuators {
    /// Number of modes in the band, with the actuators attached.
    pub mode_count: usize,
    /// Frequency of the first mode above 0 Hz, in Hz.
    pub first_mode_hz: f64,
    /// Decay time of the amplitude, in seconds: the reciprocal of the mean decay rate of the modes in the band.
    pub decay_time_s: f64,
}

impl WithActuators {
    /// Counts the modes of a surface with its actuators on it; `None` if no actuator loads the sheet, or no mode is in the band.
    pub(super) fn of(surface: &Surface, modes: &SurfaceModes) -> Option<Self> {
        let low = surface.emission.band[0];
        let modes = modes.loaded.as_ref()?;
        let first = modes.iter().find(|mode| mode.omega > 0.0)?;
        let inside: Vec<_> = modes.iter().filter(|mode| mode.omega >= TAU * low).collect();
        let decay = inside.iter().map(|mode| mode.sigma).sum::<f64>() / inside.len() as f64;
        (!inside.is_empty()).then(|| Self {
            mode_count: inside.len(),
            first_mode_hz: first.omega / TAU,
            decay_time_s: 1.0 / decay,
        })
    }
}
