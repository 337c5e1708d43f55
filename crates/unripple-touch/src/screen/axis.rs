//! The range of one of a screen's axes.

use crate::TouchError;
use unripple_core::require;

/// The range of an axis, as the screen states it, in its own unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Least coordinate that the screen reports along the axis, in its own unit.
    pub minimum: i32,
    /// Largest coordinate that the screen reports along the axis, in its own unit.
    pub maximum: i32,
}

impl Axis {
    /// A value as a fraction of the range.
    pub(super) fn share(self, value: i32) -> f64 {
        let (low, high) = (f64::from(self.minimum), f64::from(self.maximum));
        (f64::from(value) - low) / (high - low)
    }

    pub(super) fn check(self, what: &'static str) -> Result<(), TouchError> {
        let span = f64::from(self.maximum) - f64::from(self.minimum);
        Ok(require(what, span > 0.0, "more than 0", span)?)
    }
}
