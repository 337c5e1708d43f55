//! Options of a source of touches, and its limits.

use crate::error::TouchError;
use crate::mapping::Mapping;
use unripple_core::{Outline, require};

/// Options of a source of touches: the surface, the sensor's place on it, limits on what it accepts.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The surface; a place that is not on it is refused.
    pub surface: Outline,
    /// Where the sensor's area lies on the surface. The sensor's coordinates go from 0 to 1.
    pub mapping: Mapping,
    /// Time-out of a finger, in s: without a message for that long it is lifted. TUIO trackers repeat a resting
    /// finger once a second.
    pub timeout: f64,
    /// Largest number of fingers at once. Further ones are counted and dropped, unless their sender has at least two fingers fewer
    /// than the sender with the most, whose latest finger is then lifted instead.
    pub most: usize,
    /// Largest number of fingers at once from one sender, so that no sender takes the places of all others.
    pub most_per_sender: usize,
    /// Force, in N, that corresponds to the full pressure of a sensor; `None` if it is not known.
    pub full_force: Option<f64>,
}

impl Options {
    /// Defaults for a surface: a sensor that covers its bounding box, a time-out of 2 s, 32 fingers, 16 from one
    /// sender, and no conversion of pressure to force.
    pub fn new(surface: &Outline) -> Self {
        let mapping = Mapping::covering(surface);
        let surface = surface.clone();
        Self { surface, mapping, timeout: 2.0, most: 32, most_per_sender: 16, full_force: None }
    }

    /// Checks all values. The error names the first one that is out of range.
    pub fn check(&self) -> Result<(), TouchError> {
        self.mapping.check()?;
        require("time-out, s", (0.05..=3600.0).contains(&self.timeout), "0.05 to 3600", self.timeout)?;
        let counted = |n: usize| (1..=1024).contains(&n);
        require("fingers at once", counted(self.most), "1 to 1024", self.most as f64)?;
        let each = self.most_per_sender;
        require("fingers at once from one sender", counted(each), "1 to 1024", each as f64)?;
        let force = self.full_force.unwrap_or(1.0);
        Ok(require(
            "force of full pressure, N",
            force > 0.0 && force <= MOST_FORCE,
            "more than 0, at most 100",
            force,
        )?)
    }
}

/// The largest force that is accepted, in N: the weight of 10 kg. A larger value is an error of the sensor.
pub(crate) const MOST_FORCE: f64 = 100.0;
