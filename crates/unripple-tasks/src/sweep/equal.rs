//! Designs of a plan that are equal: one of them is computed, and its row serves all.

use super::design::canonical;
use super::values;
use serde_json::Value;
use std::collections::HashMap;
use unripple_store::{Axis, AxisValues, Designs, Varied};

/// Which designs of a plan are equal to earlier ones.
#[derive(Clone, Debug)]
pub(super) enum Equal {
    /// None is, as far as can be told without comparing them all: values of ranges, which are hardly ever equal.
    Different,
    /// Of a grid: for each axis the number of its steps, and for each step the first with the same value, nothing where all differ.
    Grid(Vec<(usize, Vec<usize>)>),
    /// For each design the first that is equal to it.
    Listed(Vec<usize>),
}

impl Equal {
    /// Compares the designs of a plan: those of a list and of Sobol points that are whole numbers one by one, those of a grid axis by axis.
    pub fn of(designs: &Designs) -> Self {
        let found = match designs {
            Designs::Grid(axes) => {
                let axes: Vec<_> = axes.iter().map(|axis| (axis.count().max(1), steps(axis))).collect();
                return match axes.iter().all(|(_, firsts)| firsts.is_empty()) {
                    true => Self::Different,
                    false => Self::Grid(axes),
                };
            }
            Designs::Sobol { axes, .. } if !axes.iter().all(is_whole) => Vec::new(),
            Designs::Sobol { .. } | Designs::List(_) => {
                firsts(designs.len(), |index| text(&values::of(designs, index)))
            }
        };
        if found.is_empty() { Self::Different } else { Self::Listed(found) }
    }

    /// The index of the first design that is equal to the one with an index: its own if there is no earlier one.
    pub fn first(&self, index: usize) -> usize {
        match self {
            Self::Different => index,
            Self::Listed(firsts) => firsts.get(index).copied().unwrap_or(index),
            Self::Grid(axes) => {
                let (mut left, mut weight, mut first) = (index, 1, 0);
                for (count, firsts) in axes.iter().rev() {
                    let at = left % count;
                    first += weight * firsts.get(at).copied().unwrap_or(at);
                    left /= count;
                    weight *= count;
                }
                first
            }
        }
    }
}

/// For each step of an axis the first with the same value; nothing where all differ, as do numbers between two ends unless they are rounded.
fn steps(axis: &Axis) -> Vec<usize> {
    match &axis.values {
        AxisValues::Range { log, whole, .. } if !(*log && *whole) => Vec::new(),
        own => firsts(axis.count(), |at| canonical(&values::step(own, at))),
    }
}

fn is_whole(axis: &Axis) -> bool {
    !matches!(axis.values, AxisValues::Range { whole: false, .. })
}

/// What the hash of a design follows from beside what all designs have.
fn text(values: &[(Varied, Value)]) -> String {
    let named = values.iter().map(|(varied, value)| (varied.to_string(), value.clone()));
    canonical(&Value::Object(named.collect()))
}

/// For each of some texts the first that is the same; nothing where all differ.
fn firsts(count: usize, text: impl Fn(usize) -> String) -> Vec<usize> {
    let mut seen = HashMap::new();
    let found: Vec<usize> = (0..count).map(|at| *seen.entry(text(at)).or_insert(at)).collect();
    match found.iter().enumerate().all(|(at, first)| at == *first) {
        true => Vec::new(),
        false => found,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn axis(key: &str, values: AxisValues) -> Axis {
        Axis { varied: Varied::Surface(key.into()), values }
    }

    fn range(to: f64, log: bool, whole: bool) -> AxisValues {
        AxisValues::Range { from: 1.0, to, steps: Some(6), log, whole }
    }

    /// By comparing each design with all before it.
    fn compared(designs: &Designs) -> Vec<usize> {
        let texts: Vec<String> = (0..designs.len()).map(|index| text(&values::of(designs, index))).collect();
        texts.iter().map(|own| texts.iter().position(|other| other == own).unwrap()).collect()
    }

    #[test]
    fn equal_designs_are_found_as_by_comparing_all() {
        let list = |values: Value| AxisValues::List(values.as_array().unwrap().clone());
        let one = |value: Value| vec![(Varied::Surface("a".into()), value)];
        let sobol = |whole| {
            let axes =
                vec![axis("a", AxisValues::Range { from: 1.0, to: 3.0, steps: None, log: false, whole })];
            Designs::Sobol { axes, count: 16, seed: 1 }
        };
        let all = [
            (
                Designs::Grid(vec![axis("a", list(json!([1, 2, 1.0]))), axis("b", range(8.0, true, true))]),
                true,
            ),
            (
                Designs::Grid(vec![axis("a", list(json!([1, 2, "1"]))), axis("b", range(8.0, false, true))]),
                false,
            ),
            (
                Designs::List([json!(2), json!([1, 2]), json!(2.0), json!([2, 1]), json!(2)].map(one).into()),
                true,
            ),
            (sobol(true), true),
            (sobol(false), false),
        ];
        for (designs, has_equal) in all {
            let equal = Equal::of(&designs);
            let found: Vec<usize> = (0..designs.len()).map(|index| equal.first(index)).collect();
            assert_eq!(found, compared(&designs), "{designs:?}");
            assert_eq!(!matches!(equal, Equal::Different), has_equal, "{designs:?}");
        }
    }
}
