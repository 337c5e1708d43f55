//! Dataset 55: the shape of a mode at nodes.

use super::dataset::Mode;
use super::fields::columns;
use super::lines::{Line, Records};
use crate::ExchangeError;

/// Most values of a node: three displacements, three rotations, or a tensor.
const MOST_VALUES: i64 = 9;

/// Reads a mode; `first` is the line at which its dataset begins.
pub(super) fn read(records: &mut Records<'_>, first: usize) -> Result<Mode, ExchangeError> {
    for _ in 0..5 {
        records.record("a description")?;
    }
    let line = records.record("the kind of the data")?;
    let field = |n: usize, what: &str| records.integer(line, 10 * n, 10, what);
    let (analysis, quantity) = (field(1, "the kind of analysis")?, field(3, "the quantity")?);
    let complex_values = match field(4, "the type of the data")? {
        2 => false,
        5 => true,
        other => {
            let expected = "the type of the data 2 (real) or 5 (complex)";
            return Err(records.refused_at(line.number, expected, other));
        }
    };
    let each = field(5, "the number of values of a node")?;
    if !(1..=MOST_VALUES).contains(&each) {
        return Err(records.refused_at(line.number, format!("1 to {MOST_VALUES} values of a node"), each));
    }
    let integers = records.record("the numbers of the mode")?;
    let number = records.integer(integers, 30, 10, "the number of the mode")?;
    let parameters = records.record("frequency and damping of the mode")?;
    let (eigenvalue, scale, complex) = match analysis {
        2 => real(records, parameters)?,
        3 | 7 => complex(records, parameters)?,
        other => {
            let expected = "the kind of analysis 2 (normal modes), 3 or 7 (complex modes)";
            return Err(records.refused_at(line.number, expected, other));
        }
    };
    let shape = shape(records, each as usize, complex_values)?;
    Ok(Mode { dataset: records.dataset, line: first, number, quantity, eigenvalue, scale, complex, shape })
}

/// Eigenvalue and scale of a mode, and whether it is complex.
type Parameters = ([f64; 2], [f64; 2], bool);

/// Those of a normal mode: frequency, modal mass, viscous and hysteretic damping ratio.
fn real(records: &Records<'_>, line: Line<'_>) -> Result<Parameters, ExchangeError> {
    let field = |n: usize, what: &str| records.number(line, 13 * n, 13, what);
    let (frequency, mass) = (field(0, "the frequency of the mode")?, field(1, "the modal mass")?);
    let (viscous, hysteretic) = (field(2, "the damping ratio")?, field(3, "the hysteretic damping ratio")?);
    // The loss factor of hysteretic damping is twice the damping ratio at resonance.
    let ratio = viscous + 0.5 * hysteretic;
    if frequency < 0.0 || !(0.0..1.0).contains(&ratio) {
        let found = format!("{frequency} Hz and {ratio}");
        return Err(records.refused("a frequency from 0 Hz up and a damping ratio from 0 to below 1", found));
    }
    let omega = 2.0 * std::f64::consts::PI * frequency;
    Ok(([-ratio * omega, omega * (1.0 - ratio * ratio).sqrt()], [mass, 0.0], false))
}

/// Those of a complex mode: the eigenvalue, and modal A, real and imaginary part.
fn complex(records: &Records<'_>, line: Line<'_>) -> Result<Parameters, ExchangeError> {
    let field = |n: usize, what: &str| records.number(line, 13 * n, 13, what);
    let eigenvalue = [field(0, "the eigenvalue's real part")?, field(1, "the eigenvalue's imaginary part")?];
    let scale = [field(2, "modal A")?, field(3, "the imaginary part of modal A")?];
    if eigenvalue[0] > 0.0 {
        let expected = "an eigenvalue of a mode that decays, whose real part is at most 0";
        return Err(records.refused(expected, eigenvalue[0]));
    }
    Ok((eigenvalue, scale, true))
}

/// Numbers of nodes, and their values as real and imaginary part.
type Shape = Vec<(i64, Vec<[f64; 2]>)>;

/// The values of all nodes, `each` of every node.
fn shape(records: &mut Records<'_>, each: usize, complex: bool) -> Result<Shape, ExchangeError> {
    let mut shape = Vec::new();
    let numbers = each * (1 + usize::from(complex));
    while let Some(line) = records.record_or_end("a node")? {
        let node = records.integer(line, 0, 10, "the number of a node")?;
        let mut read = Vec::with_capacity(numbers);
        while read.len() < numbers {
            let line = records.record("the values of a node")?;
            for n in 0..(numbers - read.len()).min(6) {
                let field = columns(line.bytes, 13 * n, 13).trim_ascii();
                read.push(records.finite(line, field, "a value")?);
            }
        }
        let values = match complex {
            true => read.as_chunks::<2>().0.to_vec(),
            false => read.into_iter().map(|value| [value, 0.0]).collect(),
        };
        shape.push((node, values));
    }
    Ok(shape)
}
