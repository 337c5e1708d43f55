//! What a sweep counts: designs that failed, and the least and greatest value of each figure.

use serde::Serialize;
use serde_json::Value;

/// A design that failed, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FailedDesign {
    /// Index of the design, counted from 0.
    pub index: usize,
    /// Values of the design.
    pub varied: Vec<Named>,
    /// The error of its task.
    pub error: String,
}

/// A value of a design by its name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Named {
    /// Name of the value: `surface:KEY` or `ask:FIELD`.
    pub name: String,
    /// The value, in the unit of the key or in SI units.
    pub value: Value,
}

/// Least and greatest value of one result (figure) over all designs, and the designs that have them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extreme {
    /// JSON pointer of the figure in a report.
    pub figure: String,
    /// The least value, in the figure's own SI unit.
    pub least: f64,
    /// Index of the first design that has it.
    pub least_at: usize,
    /// The greatest value, in the figure's own SI unit.
    pub greatest: f64,
    /// Index of the first design that has it.
    pub greatest_at: usize,
}

impl Extreme {
    /// A figure that has one value so far, in its SI unit.
    pub(super) fn first(figure: &str, value: f64, index: usize) -> Self {
        Self { figure: figure.into(), least: value, least_at: index, greatest: value, greatest_at: index }
    }

    /// Takes another value into account, in the figure's SI unit.
    pub(super) fn take(&mut self, value: f64, index: usize) {
        if value < self.least {
            (self.least, self.least_at) = (value, index);
        }
        if value > self.greatest {
            (self.greatest, self.greatest_at) = (value, index);
        }
    }
}
