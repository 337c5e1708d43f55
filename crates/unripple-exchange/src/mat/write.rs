//! Writes MATLAB files of version 5, without compression.

use super::HEADER;
use super::element::{DOUBLE, MATRIX};
use crate::{Array, Arrays, ExchangeError, Values};

/// Types of elements, and classes of arrays, that are written.
const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const CELL: u32 = 1;
const CHAR: u32 = 4;
const NUMBERS: u32 = 6;

/// The flag of complex numbers.
const COMPLEX: u32 = 0x0800;

/// Most letters of a name.
const MOST_LETTERS: usize = 63;

/// Writes arrays as variables of a MATLAB file, in double precision; lists of texts become cell arrays, single texts rows of letters.
///
/// # Errors
/// [`ExchangeError::Unwritable`] of a name that is no name in MATLAB, a letter beyond the first 65 536, and of more than 2 GiB in one variable.
pub fn write_mat(arrays: &Arrays) -> Result<Vec<u8>, ExchangeError> {
    let mut out = b"MATLAB 5.0 MAT-file, written by Unripple".to_vec();
    out.resize(HEADER - 4, b' ');
    // No data of a subsystem.
    out[116..124].fill(0);
    out.extend(0x0100_u16.to_le_bytes());
    out.extend(b"IM");
    for (name, array) in arrays {
        let mut letters = name.bytes();
        let first = letters.next().is_some_and(|b| b.is_ascii_alphabetic());
        if !first || !letters.all(|b| b.is_ascii_alphanumeric() || b == b'_') || name.len() > MOST_LETTERS {
            let expected = format!("names of at most {MOST_LETTERS} letters, digits and underscores");
            return Err(refused(expected, format!("`{name}`")));
        }
        element(&mut out, MATRIX, &matrix(name, array)?)?;
    }
    Ok(out)
}

/// The content of an array's element.
fn matrix(name: &str, array: &Array) -> Result<Vec<u8>, ExchangeError> {
    match &array.values {
        Values::Real(values) => {
            let mut out = described(name, NUMBERS, &axes(&array.shape))?;
            element(&mut out, DOUBLE, &doubles(&array.shape, values, |value| *value))?;
            Ok(out)
        }
        Values::Complex(values) => {
            let mut out = described(name, NUMBERS | COMPLEX, &axes(&array.shape))?;
            for part in [0, 1] {
                element(&mut out, DOUBLE, &doubles(&array.shape, values, |value| value[part]))?;
            }
            Ok(out)
        }
        Values::Text(texts) if texts.len() == 1 => letters(name, &texts[0]),
        Values::Text(texts) => {
            let mut out = described(name, CELL, &[texts.len(), 1])?;
            for text in texts {
                element(&mut out, MATRIX, &letters("", text)?)?;
            }
            Ok(out)
        }
    }
}

/// A text as a row of letters.
fn letters(name: &str, text: &str) -> Result<Vec<u8>, ExchangeError> {
    let mut letters = Vec::new();
    for letter in text.chars() {
        let code = u16::try_from(u32::from(letter));
        letters.push(code.map_err(|_| refused("letters of the basic plane", format!("`{letter}`")))?);
    }
    let mut out = described(name, CHAR, &[1, letters.len()])?;
    let bytes: Vec<u8> = letters.into_iter().flat_map(u16::to_le_bytes).collect();
    element(&mut out, UINT16, &bytes)?;
    Ok(out)
}

/// Flags, lengths of axes and name of an array.
fn described(name: &str, flags: u32, shape: &[usize]) -> Result<Vec<u8>, ExchangeError> {
    let mut out = Vec::new();
    element(&mut out, UINT32, &[flags.to_le_bytes(), [0; 4]].concat())?;
    let mut lengths = Vec::new();
    for length in shape {
        let length = i32::try_from(*length);
        lengths.extend(length.map_err(|_| refused("axes below 2^31", format!("{shape:?}")))?.to_le_bytes());
    }
    element(&mut out, INT32, &lengths)?;
    element(&mut out, INT8, name.as_bytes())?;
    Ok(out)
}

/// Lengths of at least two axes; lists are columns.
fn axes(shape: &[usize]) -> Vec<usize> {
    let mut axes = shape.to_vec();
    while axes.len() < 2 {
        axes.push(1);
    }
    axes
}

/// Numbers with the first axis running fastest.
fn doubles<T>(shape: &[usize], values: &[T], part: impl Fn(&T) -> f64) -> Vec<u8> {
    // What turns the order of axes turns it back with the lengths reversed.
    let reversed: Vec<usize> = shape.iter().rev().copied().collect();
    let numbers: Vec<f64> = values.iter().map(part).collect();
    crate::arrays::turned(&reversed, &numbers).into_iter().flat_map(f64::to_le_bytes).collect()
}

/// Appends an element, filled up to a multiple of 8 bytes.
fn element(out: &mut Vec<u8>, kind: u32, bytes: &[u8]) -> Result<(), ExchangeError> {
    let size = u32::try_from(bytes.len()).ok().filter(|size| *size <= i32::MAX as u32);
    let size =
        size.ok_or_else(|| refused("at most 2 GiB in a variable", format!("{} bytes", bytes.len())))?;
    out.extend(kind.to_le_bytes());
    out.extend(size.to_le_bytes());
    out.extend_from_slice(bytes);
    out.resize(out.len().next_multiple_of(8), 0);
    Ok(())
}

fn refused(expected: impl Into<String>, found: String) -> ExchangeError {
    ExchangeError::Unwritable { format: "MATLAB", expected: expected.into(), found }
}
