//! A target point of a focus in a request.

use crate::numbers::above_zero;
use crate::{Place, TaskError, point};
use serde::{Deserialize, Serialize};
use unripple::focus::Target;

/// A target point of a focus.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PointAsk {
    /// Place of the point, in m.
    pub at_m: Place,
    /// Level of the target relative to the other targets, a ratio; a negative value reverses the direction
    /// of motion.
    pub gain: f64,
    /// Repetition rate of the focus, in Hz; by default the focus occurs once.
    pub rate_hz: Option<f64>,
}

impl Default for PointAsk {
    fn default() -> Self {
        Self { at_m: [0.0; 2], gain: 1.0, rate_hz: None }
    }
}

impl PointAsk {
    /// A target point at `x` and `y`, in m, that is in focus once, with a gain of 1.
    pub fn at(x: f64, y: f64) -> Self {
        Self { at_m: [x, y], ..Self::default() }
    }

    /// Converts the point to a [`Target`].
    ///
    /// # Errors
    /// [`TaskError::Ask`] of a rate that is not above 0.
    pub fn target(&self) -> Result<Target, TaskError> {
        let target = Target::at(point(&self.at_m)).with_gain(self.gain);
        match self.rate_hz {
            Some(rate) => Ok(target.repeated(above_zero(rate, "rate_hz", "Hz")?)),
            None => Ok(target),
        }
    }
}
