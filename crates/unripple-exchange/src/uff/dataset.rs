//! What universal files hold: units, nodes, functions and modes.

use std::collections::BTreeMap;

/// All that is read of a universal file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uff {
    /// Units of the file (dataset 164); `None` if it does not say.
    pub units: Option<UffUnits>,
    /// Nodes (datasets 15 and 2411), in the units of the file.
    pub nodes: Vec<Node>,
    /// Functions (datasets 58 and 58b).
    pub functions: Vec<Function>,
    /// Modes (dataset 55).
    pub modes: Vec<Mode>,
    /// How many datasets of other numbers there are, by number.
    pub others: BTreeMap<String, usize>,
}

/// Units of a universal file (dataset 164).
#[derive(Clone, Debug, PartialEq)]
pub struct UffUnits {
    /// Number of the system of units: 1 is SI.
    pub code: i64,
    /// Name of the system of units.
    pub name: String,
    /// Lengths of the file are divided by this to be in metres.
    pub length: f64,
    /// Forces of the file are divided by this to be in newtons.
    pub force: f64,
}

/// A node of a universal file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Number of the node.
    pub label: i64,
    /// Place of the node, x, y and z, in the file's unit of length.
    pub at: [f64; 3],
    /// The dataset that the node is in, counted from 1.
    pub dataset: usize,
    /// The line of the file, counted from 1.
    pub line: usize,
}

/// A degree of freedom: a node and a direction.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Dof {
    /// Name of the entity; empty if there is none.
    pub name: String,
    /// Number of the node.
    pub node: i64,
    /// Direction: 1, 2 and 3 are x, y and z, their negatives the opposite ones, 4 to 6 rotations; 0 is a scalar.
    pub direction: i64,
}

/// What the values along an axis of a function are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Axis {
    /// Quantity by its number: 8 displacement, 11 velocity, 12 acceleration, 13 and 9 force, 17 time, 18 frequency, 0 and 1 others.
    pub quantity: i64,
    /// Name of the axis; empty if there is none.
    pub label: String,
    /// Unit of the axis; empty if there is none.
    pub unit: String,
}

/// A function of a universal file: values at even distances of time or frequency.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Function {
    /// The dataset of the function, counted from 1.
    pub dataset: usize,
    /// The line of the file at which it begins, counted from 1.
    pub line: usize,
    /// First line of its description; empty if there is none.
    pub title: String,
    /// Kind by its number: 1 a response in time, 4 a frequency response, 0 unknown.
    pub kind: i64,
    /// Where the response is.
    pub response: Dof,
    /// Where the reference is.
    pub reference: Dof,
    /// The first abscissa: a time in seconds or a frequency in hertz, as `abscissa` says.
    pub start: f64,
    /// Distance of two abscissae, in seconds or hertz.
    pub step: f64,
    /// The abscissa: 17 is time, 18 is frequency.
    pub abscissa: Axis,
    /// The response as a quantity with its unit.
    pub numerator: Axis,
    /// The reference that the response is divided by.
    pub denominator: Axis,
    /// Whether values are complex.
    pub complex: bool,
    /// The values; real and imaginary part after each other if they are complex.
    pub values: Vec<f64>,
}

/// A mode of a universal file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mode {
    /// The dataset of the mode, counted from 1.
    pub dataset: usize,
    /// The line of the file at which it begins, counted from 1.
    pub line: usize,
    /// Number of the mode in the file.
    pub number: i64,
    /// Quantity of the shape by its number: 8 displacement, 11 velocity, 12 acceleration.
    pub quantity: i64,
    /// The eigenvalue in 1/s: real part (the negative decay rate) and imaginary part (the damped angular frequency).
    pub eigenvalue: [f64; 2],
    /// What scales the shapes: the modal mass of a real mode, or modal A of a complex one, real and imaginary part.
    pub scale: [f64; 2],
    /// Whether it is a complex mode, scaled by modal A.
    pub complex: bool,
    /// Numbers of the nodes, and the values there, x, y and z and perhaps rotations, each as real and imaginary part.
    pub shape: Vec<(i64, Vec<[f64; 2]>)>,
}
