//! Modes from dataset 55 of universal files, and from tables of nodes by modes.

use super::labels::Labels;
use super::measured::Complex;
use super::modal::{Mode, Modes};
use super::uff_nodes::Nodes;
use crate::TaskError;
use std::f64::consts::PI;
use unripple::core::Point;
use unripple_exchange::{Csv, Row, Uff};

/// Numbers of quantities that a shape may have: displacement, and unknown ones, which are taken as displacement too.
const SHAPES: [i64; 3] = [0, 1, 8];

/// Rows of a table of modes that are no nodes.
const ROWS: [&str; 3] = ["frequency_hz", "damping_ratio", "modal_mass_kg"];

/// The modes of a universal file.
pub(super) fn of_file(uff: &Uff, file: &str, nodes: &Nodes<'_>) -> Result<Modes, TaskError> {
    let from = format!("{file}: dataset {}", uff.modes[0].dataset);
    let labels: Vec<i64> = uff.modes[0].shape.iter().map(|(label, _)| *label).collect();
    let places = labels.iter().map(|label| nodes.place(*label, &from)).collect::<Result<Vec<_>, _>>()?;
    let kilograms = nodes.kilograms()?;
    let mut modes = Vec::new();
    for mode in &uff.modes {
        let from = format!("{file}: dataset {}", mode.dataset);
        let refused = |expected: &str, found: String| {
            TaskError::Input(format!("{from}: expected {expected}, found {found}"))
        };
        if !SHAPES.contains(&mode.quantity) {
            return Err(refused("a shape of displacement, 8", mode.quantity.to_string()));
        }
        if mode.shape.len() != labels.len() || mode.shape.iter().zip(&labels).any(|((a, _), b)| a != b) {
            return Err(refused("the nodes of the first mode", "others".into()));
        }
        let [sigma, omega] = mode.eigenvalue;
        // Those of negative frequency are the conjugates of others.
        if mode.complex && omega < 0.0 {
            continue;
        }
        if omega <= 0.0 {
            return Err(refused("a mode that oscillates", format!("one of {omega} rad/s")));
        }
        let [re, im] = mode.scale.map(|part| part * kilograms);
        if re == 0.0 && im == 0.0 {
            let what = if mode.complex { "modal A" } else { "a modal mass" };
            return Err(refused(&format!("{what} other than 0"), "0".into()));
        }
        let mut shape = Vec::with_capacity(labels.len());
        for (label, values) in &mode.shape {
            let normal = match values.as_slice() {
                [alone] => alone,
                [_, _, normal, ..] => normal,
                _ => {
                    return Err(refused(
                        "one value, or three of x, y and z",
                        format!("{} at node {label}", values.len()),
                    ));
                }
            };
            shape.push(Complex::new(normal[0], normal[1]));
        }
        let eigenvalue = Complex::new(sigma, omega);
        // Normal modes have a modal mass, whose modal A is 2i m ω_d.
        let scale = if mode.complex { Complex::new(re, im) } else { Complex::new(0.0, 2.0 * re * omega) };
        modes.push(Mode { eigenvalue, shape, scale });
    }
    let names = labels.iter().map(i64::to_string).collect();
    Ok(Modes { from: file.to_owned(), names, places, modes })
}

/// The modes of a table: a column for each mode, a row for each node, and rows of frequency, damping ratio and modal mass.
pub(super) fn of_table(table: &Csv<'_>, file: &str, labels: &Labels) -> Result<Modes, TaskError> {
    let reading = Table::of(table, file, labels)?;
    let mut modes = Vec::new();
    for n in 0..reading.columns.len() {
        let [hz, ratio, mass] = [0, 1, 2].map(|row| reading.rows[row][n]);
        let name = &table.names[reading.columns[n]];
        if hz <= 0.0 || !(0.0..1.0).contains(&ratio) || mass <= 0.0 {
            return Err(TaskError::Input(format!(
                "{file}: column `{name}`: expected a frequency and a modal mass above 0 and a damping ratio from 0 to below 1, found {hz} Hz, {mass} kg and {ratio}"
            )));
        }
        let omega = 2.0 * PI * hz;
        let eigenvalue = Complex::new(-ratio * omega, omega * (1.0 - ratio * ratio).sqrt());
        let shape: Vec<f64> = reading.shapes.iter().map(|row| row[n]).collect();
        modes.push(Mode::real(eigenvalue, mass, &shape));
    }
    Ok(Modes { from: file.to_owned(), names: reading.names, places: reading.places, modes })
}

/// A table of modes that has been read.
struct Table {
    /// Columns of the modes.
    columns: Vec<usize>,
    /// Frequencies, damping ratios and modal masses.
    rows: [Vec<f64>; 3],
    names: Vec<String>,
    places: Vec<Point>,
    /// A value of each mode, for each node.
    shapes: Vec<Vec<f64>>,
}

impl Table {
    fn of(table: &Csv<'_>, file: &str, labels: &Labels) -> Result<Self, TaskError> {
        let axes = ["x_m", "y_m", "x_mm", "y_mm", "x", "y"];
        let columns: Vec<usize> =
            (1..table.names.len()).filter(|n| !axes.contains(&table.names[*n].as_str())).collect();
        let mut read = Self {
            columns,
            rows: [const { Vec::new() }; 3],
            names: Vec::new(),
            places: Vec::new(),
            shapes: Vec::new(),
        };
        for row in table.rows() {
            let row = row.map_err(TaskError::input)?;
            let values = read.columns.iter().map(|n| number(table, &row, *n, file));
            let values = values.collect::<Result<Vec<_>, _>>()?;
            match ROWS.iter().position(|name| *name == row.cells[0]) {
                Some(kind) => read.rows[kind] = values,
                None => {
                    read.places.push(labels.place_in(&table.names, &row, file)?);
                    read.names.push(row.cells[0].to_string());
                    read.shapes.push(values);
                }
            }
        }
        match ROWS.iter().zip(&read.rows).find(|(_, row)| row.is_empty()) {
            Some((name, _)) => Err(TaskError::Input(format!("{file}: expected a row `{name}`, found none"))),
            None => Ok(read),
        }
    }
}

/// The number in a cell.
fn number(table: &Csv<'_>, row: &Row<'_>, column: usize, file: &str) -> Result<f64, TaskError> {
    let cell = &row.cells[column];
    let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| {
        let name = &table.names[column];
        TaskError::Input(format!(
            "{file}: line {}: expected a finite number in the column `{name}`, found `{cell}`",
            row.line
        ))
    })
}
