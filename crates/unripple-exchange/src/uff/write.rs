//! Writes universal files: units (164), nodes (2411), modes (55) and functions (58, as text of double precision).

use super::dataset::{Axis, Dof, Function, Mode, Uff};
use crate::ExchangeError;
use std::fmt::Write;

/// The mark that begins and ends a dataset.
const MARK: &str = "    -1\n";

/// Largest integer in a field of ten columns that leaves a blank before it.
const MOST: i64 = 999_999_999;

/// Writes a universal file of text, with numbers of thirteen digits in functions and six in modes, as the format has them.
///
/// # Errors
/// [`ExchangeError::Unwritable`] of a name with other letters than ASCII or more than its field holds, a node or a number of values with more
/// than nine digits, and a number that is not finite.
pub fn write_uff(uff: &Uff) -> Result<Vec<u8>, ExchangeError> {
    let mut out = String::new();
    if let Some(units) = &uff.units {
        let name = name(&units.name, 20)?;
        let factors = [double(units.length)?, double(units.force)?, double(1.0)?, double(273.15)?];
        let [length, force, scale, offset] = factors;
        dataset(
            &mut out,
            164,
            &format!("{:10}{name:<20}{:10}\n{length}{force}{scale}\n{offset}\n", units.code, 2),
        );
    }
    if !uff.nodes.is_empty() {
        let mut text = String::new();
        for node in &uff.nodes {
            let [x, y, z] = node.at;
            let at = [double(x)?, double(y)?, double(z)?].concat();
            let label = integer(node.label)?;
            line(&mut text, format_args!("{label:>10}{:10}{:10}{:10}\n{at}", 0, 0, 1));
        }
        dataset(&mut out, 2411, &text);
    }
    for mode in &uff.modes {
        let text = written_mode(mode)?;
        dataset(&mut out, 55, &text);
    }
    for function in &uff.functions {
        let text = written_function(function)?;
        dataset(&mut out, 58, &text);
    }
    Ok(out.into_bytes())
}

/// Appends a dataset between its marks.
fn dataset(out: &mut String, number: usize, text: &str) {
    line(out, format_args!("{MARK}{number:6}\n{text}{}", MARK.trim_end_matches('\n')));
}

/// Appends a line. Writing to a string never fails.
fn line(out: &mut String, text: std::fmt::Arguments<'_>) {
    let _ = writeln!(out, "{text}");
}

fn written_mode(mode: &Mode) -> Result<String, ExchangeError> {
    let mut text = String::new();
    let [real, imaginary] = mode.eigenvalue;
    let omega = real.hypot(imaginary);
    let hz = omega / (2.0 * std::f64::consts::PI);
    line(&mut text, format_args!("Mode {} at {hz:.3} Hz\nNONE\nNONE\nNONE\nNONE", mode.number));
    let each = mode.shape.first().map_or(1, |(_, values)| values.len());
    let same = mode.shape.iter().all(|(_, values)| values.len() == each);
    if !same || !(1..=9).contains(&each) {
        return Err(refused("as many values at each node, at most 9", "others"));
    }
    let characteristic = match each {
        1 => 1,
        3 => 2,
        6 => 3,
        _ => 0,
    };
    let (analysis, kind) = if mode.complex { (3, 5) } else { (2, 2) };
    let (quantity, number) = (integer(mode.quantity)?, integer(mode.number)?);
    line(&mut text, format_args!("{:10}{analysis:10}{characteristic:10}{quantity:>10}{kind:10}{each:10}", 1));
    let parameters = match mode.complex {
        false => {
            let ratio = if omega > 0.0 { -real / omega } else { 0.0 };
            vec![hz, mode.scale[0], ratio, 0.0]
        }
        // Modal B is minus the eigenvalue times modal A.
        true => {
            let [a, b] = mode.scale;
            let modal_b = [imaginary * b - real * a, -real * b - imaginary * a];
            vec![real, imaginary, a, b, modal_b[0], modal_b[1]]
        }
    };
    line(&mut text, format_args!("{:10}{:10}{:10}{number:>10}", 2, parameters.len(), 1));
    singles(&mut text, &parameters)?;
    for (node, values) in &mode.shape {
        let node = integer(*node)?;
        line(&mut text, format_args!("{node:>10}"));
        let parts: Vec<f64> = match mode.complex {
            true => values.iter().flatten().copied().collect(),
            false => values.iter().map(|value| value[0]).collect(),
        };
        singles(&mut text, &parts)?;
    }
    Ok(text)
}

fn written_function(function: &Function) -> Result<String, ExchangeError> {
    let mut text = String::new();
    let title = named(&function.title, 80)?;
    line(&mut text, format_args!("{title}\nNONE\nNONE\nNONE\nNONE"));
    let kind = integer(function.kind)?;
    let [response, reference] = [dof(&function.response)?, dof(&function.reference)?];
    line(&mut text, format_args!("{kind:>5}{:10}{:5}{:10}{response}{reference}", 1, 0, 0));
    let (data, parts) = if function.complex { (6, 2) } else { (4, 1) };
    let count = integer((function.values.len() / parts) as i64)?;
    let abscissa = [single(function.start)?, single(function.step)?, single(0.0)?].concat();
    line(&mut text, format_args!("{data:10}{count:>10}{:10}{abscissa}", 1));
    for axis in [&function.abscissa, &function.numerator, &function.denominator, &Axis::default()] {
        let (label, unit) = (named(&axis.label, 20)?, named(&axis.unit, 20)?);
        let quantity = integer(axis.quantity)?;
        line(&mut text, format_args!("{quantity:>10}{:5}{:5}{:5} {label:<20} {unit:<20}", 0, 0, 0));
    }
    for four in function.values.chunks(4) {
        for value in four {
            finite(*value)?;
            let _ = write!(text, "{:>20}", scientific(*value, 12));
        }
        text.push('\n');
    }
    Ok(text)
}

/// Fields of a degree of freedom, with the blank before them.
fn dof(dof: &Dof) -> Result<String, ExchangeError> {
    let (name, node) = (named(&dof.name, 10)?, integer(dof.node)?);
    if !(-999..=999).contains(&dof.direction) {
        return Err(refused("a direction of at most three digits", dof.direction));
    }
    Ok(format!(" {name:<10}{node:>10}{:>4}", dof.direction))
}

/// Appends numbers of six digits, six of them a line.
fn singles(text: &mut String, values: &[f64]) -> Result<(), ExchangeError> {
    for six in values.chunks(6) {
        for value in six {
            text.push_str(&single(*value)?);
        }
        text.push('\n');
    }
    Ok(())
}

fn single(value: f64) -> Result<String, ExchangeError> {
    finite(value)?;
    Ok(format!("{:>13}", scientific(value, 5)))
}

fn double(value: f64) -> Result<String, ExchangeError> {
    finite(value)?;
    Ok(format!("{:>25}", scientific(value, 16).replace('E', "D")))
}

/// A number as Fortran writes it: the sign of the exponent always there, and two digits at least.
fn scientific(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, exponent) = exponent.strip_prefix('-').map_or(('+', exponent), |exponent| ('-', exponent));
    format!("{mantissa}E{sign}{exponent:0>2}")
}

fn integer(value: i64) -> Result<String, ExchangeError> {
    match (-MOST..=MOST).contains(&value) {
        true => Ok(value.to_string()),
        false => Err(refused(format!("numbers of at most {MOST}"), value)),
    }
}

fn finite(value: f64) -> Result<(), ExchangeError> {
    if value.is_finite() { Ok(()) } else { Err(refused("finite numbers", value)) }
}

/// A text for a field that holds `NONE` where there is no text.
fn named(text: &str, most: usize) -> Result<String, ExchangeError> {
    if text.is_empty() { Ok("NONE".into()) } else { name(text, most) }
}

/// A text of at most `most` ASCII letters.
fn name(text: &str, most: usize) -> Result<String, ExchangeError> {
    match text.len() <= most && text.bytes().all(|b| (b' '..=b'~').contains(&b)) {
        true => Ok(text.to_owned()),
        false => Err(refused(format!("names of at most {most} ASCII letters"), format!("`{text}`"))),
    }
}

fn refused(expected: impl Into<String>, found: impl std::fmt::Display) -> ExchangeError {
    ExchangeError::Unwritable { format: "UFF", expected: expected.into(), found: found.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_columns_of_fortran() {
        assert_eq!(single(-1.5e-101).unwrap(), "-1.50000E-101");
        assert_eq!(single(1234.5).unwrap(), "  1.23450E+03");
        assert_eq!(double(0.0).unwrap().len(), 25);
        assert_eq!(scientific(0.0, 5), "0.00000E+00");
        assert!(single(f64::NAN).is_err() && integer(MOST + 1).is_err() && name("é", 9).is_err());
    }
}
