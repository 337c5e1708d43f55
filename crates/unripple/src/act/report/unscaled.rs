//! What is left of a report where nobody knows what the responses' level is.

use super::Report;
use crate::field::TargetFigures;

impl Report {
    /// Takes out every figure that is a length, a velocity or a level: responses without a scale tell ratios, instants and places alone.
    /// Numbers without meaning are NaN, `null` in JSON.
    #[must_use]
    pub fn without_scale(mut self) -> Self {
        let ratios = |target: TargetFigures| TargetFigures {
            peak_velocity_m_s: f64::NAN,
            peak_displacement_m: f64::NAN,
            felt_level_db: None,
            velocity_range_m_s: None,
            displacement_range_m: None,
            ..target
        };
        self.targets = std::mem::take(&mut self.targets).into_iter().map(ratios).collect();
        self.felt_outside_db = None;
        self.linearity = None;
        self.level = self.level.map(|level| level.allowing(None));
        self.notes.retain(|note| note.topic != "linear theory");
        self
    }
}
