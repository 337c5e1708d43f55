//! A suspected cause of a difference, with what it leaves unexplained.

use super::WireFault;

/// A cause of a difference between recorded and predicted signals.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// The tension is `ratio` times that of the model.
    Tension {
        /// Tension relative to that of the model.
        ratio: f64,
    },
    /// Wires are exchanged, reversed or dead.
    Wires(Vec<WireFault>),
    /// An amplifier saturates: the louder recording has less than the quieter one.
    Saturation {
        /// Magnitude at which the drive seems to be clipped, in its unit.
        clip: f64,
    },
    /// Gains of single actuators differ.
    Gains,
    /// Noise of the probe.
    Noise,
}

impl Cause {
    /// Name of the cause in reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Tension { .. } => "tension",
            Self::Wires(_) => "wires",
            Self::Saturation { .. } => "saturation",
            Self::Gains => "gains",
            Self::Noise => "noise",
        }
    }
}

/// A cause with what it leaves unexplained.
#[derive(Clone, Debug, PartialEq)]
pub struct Suspect {
    /// What may be wrong.
    pub cause: Cause,
    /// Amplitude that stays unexplained if this is the cause, as a share of the recordings'.
    pub left: f64,
}
