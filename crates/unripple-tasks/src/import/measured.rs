//! A response as it was read, before units are settled.

use super::{Kind, Per, Quantity};
use unripple::core::Point;

/// Complex numbers as the transforms have them.
pub(super) type Complex = unripple::dsp::Complex<f64>;

/// A response as it was read.
pub(super) struct Measured {
    /// File and place in it, for messages.
    pub from: String,
    /// The actuator, as the file names it.
    pub who: Who,
    /// Place of the point, in m.
    pub at: Point,
    /// The values, in the units of the file.
    pub signal: Signal,
    /// Factor of the values: -1 if response and reference point in opposite directions.
    pub sign: f64,
    /// What the file says about the values.
    pub says: Says,
}

/// What is known of an actuator from a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Who {
    /// Names that stand for it, such as that of a node.
    pub names: Vec<String>,
    /// Its place in m, if the file says it.
    pub at: Option<Point>,
}

/// Values at even times or frequencies.
#[derive(Clone, Debug)]
pub(super) enum Signal {
    /// Values in time: first time and distance of two times in seconds.
    Time { start: f64, step: f64, values: Vec<f64> },
    /// Values in frequency: first frequency and distance of two frequencies in hertz.
    Frequency { start: f64, step: f64, values: Vec<Complex> },
}

/// What a file says about its values.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Says {
    /// What the values are.
    pub kind: Option<Kind>,
    /// What was measured at the point, apart from its unit.
    pub quantity: Option<Quantity>,
    /// Quantity and SI units per unit of the values, from the name of a unit.
    pub unit: Option<(Quantity, f64)>,
    /// Metres per unit of length of the file.
    pub length: Option<f64>,
    /// The reference, and SI units per unit of it, from the name of a unit.
    pub per: Option<(Per, f64)>,
}
