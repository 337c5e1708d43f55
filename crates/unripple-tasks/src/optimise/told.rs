//! Designs with what came of them, as an optimiser is told.

use crate::sweep::Row;
use serde_json::{Value, json};
use unripple_store::{Bound, SearchFile, Varied, Want};

/// A design with what came of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Told {
    /// The generation that it is of, counted from 0.
    pub generation: usize,
    /// Its index among all designs of the search, counted from 0.
    pub index: usize,
    /// What came of it.
    pub row: Row,
    /// A number for each objective, the smaller the better; `None` if the design failed or an objective or a constraint has no number.
    pub losses: Option<Vec<f64>>,
    /// How far it is out of its bounds: the sum of the shares of the bounds; 0 if it keeps all.
    pub violation: f64,
    /// Why the design counts as failed; `None` if it does not.
    pub error: Option<String>,
}

impl Told {
    /// A row of a generation, with its index among all designs.
    pub fn of(search: &SearchFile, generation: usize, index: usize, row: Row) -> Self {
        match judged(search, &row) {
            Ok((losses, violation)) => {
                Self { generation, index, row, losses: Some(losses), violation, error: None }
            }
            Err(error) => Self { generation, index, row, losses: None, violation: 0.0, error: Some(error) },
        }
    }

    /// The losses of a design that keeps all constraints, a number for each objective; `None` of any other.
    pub fn feasible(&self) -> Option<&[f64]> {
        self.losses.as_deref().filter(|_| self.violation == 0.0)
    }

    /// The value of an unknown by its name; null if it has none.
    pub fn value(&self, name: &str) -> Value {
        self.row.values.get(name).cloned().unwrap_or_default()
    }

    /// What varies with its values, in the order of the plan.
    pub fn design(&self, search: &SearchFile) -> Vec<(Varied, Value)> {
        search.axes.iter().map(|axis| (axis.varied.clone(), self.value(&axis.varied.to_string()))).collect()
    }

    /// What an optimiser is told of it.
    pub fn json(&self, names: &[String]) -> Value {
        let values: Vec<Value> = names.iter().map(|name| self.value(name)).collect();
        json!({ "values": values, "losses": self.losses, "violation": self.violation })
    }
}

/// The loss of a value of an objective, and the value of a loss.
pub(super) fn turned(want: Want, value: f64) -> f64 {
    if want == Want::Most { -value } else { value }
}

/// The losses of a row, and how far it is out of its bounds; otherwise why neither is known.
fn judged(search: &SearchFile, row: &Row) -> Result<(Vec<f64>, f64), String> {
    if let Some(error) = &row.error {
        return Err(error.clone());
    }
    let number = |figure: &str| {
        let found = row.figures.get(figure).and_then(Value::as_f64).filter(|found| found.is_finite());
        found.ok_or_else(|| format!("no number at {figure}"))
    };
    let losses = search.objectives.iter().map(|objective| -> Result<f64, String> {
        // One zero, of which no sign is before another.
        Ok(0.0 + turned(objective.want, number(&objective.figure)?))
    });
    let losses = losses.collect::<Result<Vec<f64>, String>>()?;
    let mut violation = 0.0;
    for bound in &search.constraints {
        violation += beyond(bound, number(&bound.figure)?);
    }
    Ok((losses, violation))
}

/// How far a figure is out of bounds, as a share of the bound, or in its own unit where the bound is 0.
fn beyond(bound: &Bound, found: f64) -> f64 {
    let share = |bound: f64, over: f64| over.max(0.0) / if bound == 0.0 { 1.0 } else { bound.abs() };
    let low = bound.at_least.map_or(0.0, |least| share(least, least - found));
    low + bound.at_most.map_or(0.0, |most| share(most, found - most))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_count_as_shares() {
        let bound = |at_least, at_most| Bound { figure: "/a".into(), at_least, at_most };
        assert_eq!(beyond(&bound(None, Some(2.0)), 3.0), 0.5);
        assert_eq!(beyond(&bound(Some(-4.0), None), -5.0), 0.25);
        assert_eq!(beyond(&bound(Some(0.0), None), -0.5), 0.5);
        assert_eq!(beyond(&bound(Some(1.0), Some(2.0)), 1.5), 0.0);
    }
}
