//! Heat that a drive makes in the coils of a surface.

use crate::core::{CoilDrive, Drive, Surface};
use serde::Serialize;

/// Mean heat in the coils of a surface under a drive, over the whole drive or its last period.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CoilHeat {
    /// Mean heat in all coils together, in W.
    pub total_w: f64,
    /// Mean heat in the coil with the most, in W.
    pub largest_w: f64,
    /// Whether `total_w` and `largest_w` are upper bounds, as for coils driven by a voltage: inductance and
    /// the motion of the magnets keep currents lower.
    pub at_most: bool,
}

impl CoilHeat {
    /// Heat over the last `seconds` of a drive; `None` without coils.
    ///
    /// A current i heats a coil of resistance R by R i². A voltage V does so by at most V²/R: an inductance and the motion of the magnet,
    /// which takes no less than nothing, only add to the impedance.
    pub(super) fn of(surface: &Surface, drive: &Drive, seconds: f64) -> Option<Self> {
        let samples = (seconds * drive.rate()).round() as usize;
        let mean_square = |channel: &[f64]| {
            let last = &channel[channel.len().saturating_sub(samples)..];
            last.iter().map(|d| d * d).sum::<f64>() / last.len().max(1) as f64
        };
        let mut heat = Self { total_w: 0.0, largest_w: 0.0, at_most: false };
        let mut coils = 0;
        for (actuator, channel) in surface.actuators.iter().zip(drive.channels()) {
            let Some(coil) = actuator.kind.coil() else { continue };
            let own = match coil.driven_by {
                CoilDrive::Current => mean_square(channel) * coil.resistance,
                CoilDrive::Voltage => mean_square(channel) / coil.resistance,
            };
            heat.total_w += own;
            heat.largest_w = heat.largest_w.max(own);
            heat.at_most |= coil.driven_by == CoilDrive::Voltage;
            coils += 1;
        }
        (coils > 0).then_some(heat)
    }
}
