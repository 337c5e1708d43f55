//! Datasets 15 and 2411, nodes, and 164, units.

use super::dataset::{Node, UffUnits};
use super::fields::text;
use super::lines::Records;
use crate::ExchangeError;

/// Reads the nodes of a dataset; `is_double` says whether it is 2411, which has a record of its own for the coordinates.
pub(super) fn read(
    records: &mut Records<'_>,
    nodes: &mut Vec<Node>,
    is_double: bool,
) -> Result<(), ExchangeError> {
    let dataset = records.dataset;
    while let Some(line) = records.record_or_end("a node")? {
        if line.is_blank() {
            continue;
        }
        let label = records.integer(line, 0, 10, "the number of a node")?;
        if label <= 0 {
            let expected = "the number of a node, from 1 up, in columns 1 to 10";
            return Err(records.refused_at(line.number, expected, label));
        }
        let number = line.number;
        let (line, start, width) = match is_double {
            true => (records.record("the coordinates of a node")?, 0, 25),
            false => (line, 40, 13),
        };
        let mut at = [0.0; 3];
        for (axis, coordinate) in at.iter_mut().enumerate() {
            *coordinate = records.number(line, start + axis * width, width, "a coordinate")?;
        }
        nodes.push(Node { label, at, dataset, line: number });
    }
    Ok(())
}

/// Reads the units of a file.
pub(super) fn units(records: &mut Records<'_>) -> Result<UffUnits, ExchangeError> {
    let line = records.record("a system of units")?;
    let (code, name) = (records.integer(line, 0, 10, "a system of units")?, text(line.bytes, 10, 20));
    let line = records.record("factors of units")?;
    let length = records.number(line, 0, 25, "the factor of lengths")?;
    let force = records.number(line, 25, 25, "the factor of forces")?;
    for (what, factor) in [("lengths", length), ("forces", force)] {
        if factor <= 0.0 {
            return Err(records.refused_at(line.number, format!("a factor of {what} above 0"), factor));
        }
    }
    // Temperatures.
    records.skip_dataset()?;
    Ok(UffUnits { code, name, length, force })
}
