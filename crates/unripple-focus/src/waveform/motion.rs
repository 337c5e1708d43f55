//! The motion that a target is to follow.

use unripple_core::Point;

/// A target, and the waveform that its motion is to follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    /// Place of the target, in metres: a point, or a set of points that are all to have this motion.
    pub points: Vec<Point>,
    /// Samples of the motion, at the sample rate of the responses: in metres, or in m/s with
    /// [`Quantity::Velocity`].
    pub samples: Vec<f64>,
    /// Seconds from the start of the first waveform to the start of this one; rounded to a sample.
    pub delay: f64,
}

impl Waveform {
    /// A waveform at one point (m), without delay, with samples in m or m/s.
    pub fn at(point: Point, samples: Vec<f64>) -> Self {
        Self { points: vec![point], samples, delay: 0.0 }
    }

    /// This waveform, delayed by `delay` seconds.
    pub fn delayed(self, delay: f64) -> Self {
        Self { delay, ..self }
    }
}

/// Physical quantity of the samples of a waveform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement, in metres.
    #[default]
    Displacement,
    /// Velocity, in m/s.
    Velocity,
}
