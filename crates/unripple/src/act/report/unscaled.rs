//! Reports on responses whose absolute scale is unknown.

use super::Report;
use crate::act::Sound;
use crate::field::TargetFigures;

impl Report {
    /// Removes every absolute displacement, velocity and level, for responses without a known scale: they determine
    /// ratios, instants and positions only. The removed numbers are NaN, `null` in JSON.
    #[must_use]
    pub fn without_scale(mut self) -> Self {
        self.targets = std::mem::take(&mut self.targets).into_iter().map(ratios_of).collect();
        self.felt_outside_db = None;
        self.linearity = None;
        self.mean_mechanical_power_w = None;
        self.sound = self.sound.map(Sound::without_scale);
        self.level = self.level.map(|level| level.allowing(None));
        self.notes.retain(|note| note.topic != "linear theory");
        self
    }
}

/// The figures of a target without absolute displacements, velocities and levels, for responses without a known scale: ratios, instants and
/// positions are left. The removed numbers are NaN, `null` in JSON.
pub fn ratios_of(target: TargetFigures) -> TargetFigures {
    TargetFigures {
        peak_velocity_m_s: f64::NAN,
        peak_displacement_m: f64::NAN,
        felt_level_db: None,
        velocity_range_m_s: None,
        displacement_range_m: None,
        ..target
    }
}
