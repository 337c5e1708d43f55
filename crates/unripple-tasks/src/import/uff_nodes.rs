//! Nodes of universal files, and the units of their places.

use super::labels::Labels;
use crate::TaskError;
use std::collections::BTreeMap;
use unripple::core::Point;
use unripple_exchange::Uff;

/// Largest distance from one plane that nodes may have, as a share of their extent: what is farther off is no flat sheet.
const FLAT: f64 = 1e-3;

/// Units of a universal file: metres and newtons in its units.
pub(super) type Units = Option<(f64, f64)>;

/// Nodes of a universal file by their numbers.
pub(super) struct Nodes<'a> {
    at: BTreeMap<i64, [f64; 2]>,
    length: Option<f64>,
    labels: &'a Labels,
    file: &'a str,
    /// Metres and newtons in the units of the file.
    pub units: Units,
}

impl<'a> Nodes<'a> {
    /// The nodes of a file.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a node at two places, and of nodes that do not lie in a plane of constant z.
    pub fn of(uff: &Uff, file: &'a str, labels: &'a Labels) -> Result<Self, TaskError> {
        let mut at = BTreeMap::new();
        for node in &uff.nodes {
            let [x, y, z] = node.at;
            if let Some([u, v, w]) = at.insert(node.label, node.at).filter(|other| *other != node.at) {
                return Err(TaskError::Input(format!(
                    "{file}: dataset {}, line {}: expected node {} at {u}, {v}, {w} as before, found {x}, {y}, {z}",
                    node.dataset, node.line, node.label
                )));
            }
        }
        flat(&at, file)?;
        let units = uff.units.as_ref().map(|units| (1.0 / units.length, 1.0 / units.force));
        // Options go first.
        let length = labels.length().or(units.map(|(metres, _)| metres));
        let at = at.into_iter().map(|(label, [x, y, _])| (label, [x, y])).collect();
        Ok(Self { at, length, labels, file, units })
    }

    /// The place of a node in m, from the table of the request or from the file; `None` if neither has it.
    ///
    /// # Errors
    /// [`TaskError::Ask`] if the unit of length is not known.
    pub fn known(&self, label: i64) -> Result<Option<Point>, TaskError> {
        if let Some(at) = self.labels.node(label) {
            return Ok(Some(at));
        }
        let Some([x, y]) = self.at.get(&label) else { return Ok(None) };
        let metres = self.length.map_or_else(|| self.labels.needed_length(self.file), Ok)?;
        Ok(Some(self.labels.moved(metres * x, metres * y)))
    }

    /// Kilograms in the unit of mass of the file, by its units of force and length.
    ///
    /// # Errors
    /// [`TaskError::Ask`] if these are not known.
    pub fn kilograms(&self) -> Result<f64, TaskError> {
        if let Some((metres, newtons)) = self.units {
            return Ok(newtons / metres);
        }
        match (self.length, self.labels.in_newtons()) {
            (Some(metres), true) => Ok(1.0 / metres),
            _ => {
                let expected = "the units of length and force, by which modal masses are known";
                let found = format!("none, and {} has no dataset 164", self.file);
                Err(TaskError::ask("length_unit, per", expected, found))
            }
        }
    }

    /// The place of a node, in m.
    ///
    /// # Errors
    /// [`TaskError::Input`] of a node without a place, and those of [`known`](Self::known).
    pub fn place(&self, label: i64, from: &str) -> Result<Point, TaskError> {
        self.known(label)?.ok_or_else(|| {
            TaskError::Input(format!(
                "{from}: expected the place of node {label} in dataset 15 or 2411, or in `table`, found none"
            ))
        })
    }
}

/// Refuses nodes that do not lie in a plane of constant z.
fn flat(nodes: &BTreeMap<i64, [f64; 3]>, file: &str) -> Result<(), TaskError> {
    let extent = |axis: usize| {
        let all = nodes.values().map(|at| at[axis]);
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        (high - low).max(0.0)
    };
    let [x, y, z] = [0, 1, 2].map(extent);
    if nodes.len() < 2 || z <= FLAT * x.max(y) {
        return Ok(());
    }
    Err(TaskError::Input(format!(
        "{file}: expected nodes in one plane of constant z, found {z} between the lowest and the highest"
    )))
}
