//! What a search has found, and how it went.

use super::told::Told;
use crate::sweep::Named;
use serde::Serialize;
use serde_json::Value;

/// A design that is the best, or one of the front.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Good {
    /// Index of the design among all of the search, counted from 0.
    pub index: usize,
    /// The generation that it is of, counted from 0.
    pub generation: usize,
    /// Values of the unknowns, in the order of the plan.
    pub varied: Vec<Named>,
    /// The figures that are kept, those of the objectives first, in SI units.
    pub figures: Vec<Named>,
}

/// What one generation brought.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// The generation, counted from 0.
    pub generation: usize,
    /// Number of its designs.
    pub designs: usize,
    /// How many of them failed.
    pub failed: usize,
    /// With one objective: its best value so far, in its SI unit, among designs that keep all constraints; `None` if there is none yet.
    pub best: Option<f64>,
    /// Number of designs that no other one was better than so far.
    pub front: usize,
}

impl Good {
    /// A design with the values of the unknowns of these names.
    pub(super) fn of(told: &Told, names: &[String]) -> Self {
        let named = |(name, value): (String, Value)| Named { name, value };
        let varied = names.iter().map(|name| Named { name: name.clone(), value: told.value(name) });
        Self {
            index: told.index,
            generation: told.generation,
            varied: varied.collect(),
            figures: told.row.figures.0.iter().cloned().map(named).collect(),
        }
    }
}
