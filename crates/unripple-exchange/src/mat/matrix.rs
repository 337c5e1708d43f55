//! Arrays of a MATLAB file.

use super::element::{Element, MATRIX};
use crate::arrays::{product, turned};
use crate::bytes::{Bytes, Order};
use crate::room::{self, Room};
use crate::{Array, ExchangeError, Place, Values};

/// Classes of arrays: lists of arrays, texts, and numbers from the first to the last.
const CELL: u32 = 1;
const CHAR: u32 = 4;
const FIRST_NUMBER: u32 = 6;
const LAST_NUMBER: u32 = 15;

/// The bit of the flags that says that numbers are complex.
const COMPLEX: u32 = 0x0800;

/// Reads an array and its name; `None` of a class that is not read here. `depth` counts the lists around it.
pub(super) fn read(
    element: Element<'_>,
    order: Order,
    depth: usize,
    room: &mut Room<'_>,
) -> Result<Option<(String, Array)>, ExchangeError> {
    let mut parts = Bytes::of(element.bytes, element.at, room.file);
    // An array of nothing, as in a list that was never filled.
    if parts.left() == 0 {
        return Ok(None);
    }
    let flags = Element::next(&mut parts, order)?;
    let flags = order.u32(flags.bytes);
    let shape = shape(Element::next(&mut parts, order)?, order, room)?;
    let name = Element::next(&mut parts, order)?.letters(order, room)?;
    let name: String = name.into_iter().filter(|letter| *letter != '\0').collect();
    let array = match flags & 0xff {
        CHAR => Some(text(&mut parts, &shape, order, room)?),
        CELL if depth == 0 => texts(&mut parts, &shape, order, room)?,
        FIRST_NUMBER..=LAST_NUMBER => {
            let complex = flags & COMPLEX != 0;
            Some(numbers(&mut parts, shape, complex, order, &name, room)?)
        }
        _ => None,
    };
    Ok(array.map(|array| (name, array)))
}

/// Lengths of the axes.
fn shape(element: Element<'_>, order: Order, room: &mut Room<'_>) -> Result<Vec<usize>, ExchangeError> {
    let lengths = element.numbers(order, room)?;
    let shape: Vec<usize> =
        lengths.iter().filter(|length| **length >= 0.0).map(|length| *length as usize).collect();
    if shape.len() == lengths.len() && shape.len() >= 2 && product(&shape).is_some() {
        return Ok(shape);
    }
    let found = format!("{lengths:?}");
    Err(ExchangeError::content(room.file, Place::Byte(element.at), "the lengths of two axes or more", found))
}

fn numbers(
    parts: &mut Bytes<'_>,
    shape: Vec<usize>,
    complex: bool,
    order: Order,
    name: &str,
    room: &mut Room<'_>,
) -> Result<Array, ExchangeError> {
    let mut part = || -> Result<Vec<f64>, ExchangeError> {
        let element = Element::next(parts, order)?;
        let numbers = element.numbers(order, room)?;
        if Some(numbers.len()) == product(&shape) {
            return Ok(turned(&shape, &numbers));
        }
        let expected = format!("as many numbers as the shape {shape:?} of `{name}` has");
        Err(parts.refused(expected, numbers.len()))
    };
    let real = part()?;
    let values = match complex {
        true => Values::Complex(real.into_iter().zip(part()?).map(|(re, im)| [re, im]).collect()),
        false => Values::Real(real),
    };
    Ok(Array { shape, values })
}

/// Rows of letters, each a text.
fn text(
    parts: &mut Bytes<'_>,
    shape: &[usize],
    order: Order,
    room: &mut Room<'_>,
) -> Result<Array, ExchangeError> {
    let element = Element::next(parts, order)?;
    let letters = element.letters(order, room)?;
    let rows = shape[0];
    room.take(rows.min(letters.len()), room::TEXT, Place::Byte(element.at))?;
    // One text, of letters that may take several bytes each.
    if rows <= 1 {
        return Ok(Array::texts(vec![letters.into_iter().collect()]));
    }
    if shape.len() != 2 || Some(letters.len()) != product(shape) || shape[1] == 0 {
        return Err(parts.refused(format!("letters of the shape {shape:?}"), letters.len()));
    }
    let letters = turned(shape, &letters);
    let rows = letters.chunks_exact(shape[1]).map(|row| row.iter().collect::<String>().trim_end().to_owned());
    Ok(Array::texts(rows.collect()))
}

/// A list of texts; `None` if there is anything else in it.
fn texts(
    parts: &mut Bytes<'_>,
    shape: &[usize],
    order: Order,
    room: &mut Room<'_>,
) -> Result<Option<Array>, ExchangeError> {
    let mut texts = Vec::new();
    for _ in 0..product(shape).unwrap_or(0) {
        let element = Element::next(parts, order)?;
        if element.kind != MATRIX {
            return Err(parts.refused("an array in a list", format!("type {}", element.kind)));
        }
        match read(element, order, 1, room)? {
            Some((_, Array { values: Values::Text(mut text), .. })) if text.len() == 1 => {
                texts.append(&mut text);
            }
            _ => return Ok(None),
        }
    }
    Ok(Some(Array::texts(texts)))
}
