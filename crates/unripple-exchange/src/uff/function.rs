//! Datasets 58 and 58b: a function of time or frequency.

use super::dataset::{Axis, Dof, Function};
use super::fields::text;
use super::lines::{Line, Records};
use super::values::{self, Coding, Layout};
use crate::ExchangeError;
use crate::bytes::Order;

/// Reads a function; `head` is the first line of its dataset.
pub(super) fn read<'a>(records: &mut Records<'a>, head: Line<'a>) -> Result<Function, ExchangeError> {
    let binary = binary(records, head)?;
    let mut title = String::new();
    for number in 0..5 {
        let line = records.record("a description")?;
        if number == 0 {
            title = text(line.bytes, 0, 80);
        }
    }
    let line = records.record("the degrees of freedom")?;
    let function = Function {
        dataset: records.dataset,
        line: head.number,
        title,
        kind: records.integer(line, 0, 5, "the kind of the function")?,
        response: dof(records, line, 31)?,
        reference: dof(records, line, 56)?,
        ..Function::default()
    };
    let line = records.record("the form of the data")?;
    let form = form(records, line)?;
    let start = records.number(line, 30, 13, "the first abscissa")?;
    let step = records.number(line, 43, 13, "the distance of abscissae")?;
    let [abscissa, numerator, denominator] = [(); 3].map(|()| axis(records));
    let function = Function {
        abscissa: abscissa?,
        numerator: numerator?,
        denominator: denominator?,
        complex: form.complex,
        ..function
    };
    axis(records)?;
    if form.even && step <= 0.0 {
        return Err(records.refused_at(line.number, "a distance of abscissae above 0", step));
    }
    let numbers = match binary {
        Some((order, bytes)) => values::binary(records, form, order, bytes)?,
        None => values::text(records, form)?,
    };
    records.end()?;
    match form.even {
        true => Ok(Function { start, step, values: numbers, ..function }),
        false => values::evened(records, form, &numbers, function, line.number),
    }
}

/// Byte order and number of bytes of a binary function; `None` of one in text.
fn binary(records: &Records<'_>, head: Line<'_>) -> Result<Option<(Order, usize)>, ExchangeError> {
    let number = text(head.bytes, 0, 80);
    let mut fields = number.split_whitespace();
    if fields.next() != Some("58b") {
        return Ok(None);
    }
    let mut field = |what: &str| {
        let read = fields.next().and_then(|field| field.parse::<i64>().ok());
        read.ok_or_else(|| records.refused_at(head.number, format!("{what} behind 58b"), "no integer"))
    };
    let order = match field("the order of bytes")? {
        1 => Order::Little,
        2 => Order::Big,
        other => return Err(records.refused_at(head.number, "the order of bytes 1 or 2", other)),
    };
    match field("the format of numbers")? {
        2 => {}
        other => {
            return Err(records.refused_at(head.number, "numbers of the format 2 (IEEE 754)", other));
        }
    }
    match field("the number of lines")? {
        11 => {}
        other => return Err(records.refused_at(head.number, "11 lines before the values", other)),
    }
    let bytes = field("the number of bytes")?;
    let count = usize::try_from(bytes)
        .map_err(|_| records.refused_at(head.number, "the number of bytes, from 0 up", bytes))?;
    Ok(Some((order, count)))
}

/// A degree of freedom, whose name begins in the column `start`, from 0.
fn dof(records: &Records<'_>, line: Line<'_>, start: usize) -> Result<Dof, ExchangeError> {
    Ok(Dof {
        name: text(line.bytes, start, 10),
        node: records.integer(line, start + 10, 10, "the number of a node")?,
        direction: records.integer(line, start + 20, 4, "a direction")?,
    })
}

/// How the values are written, and how many there are.
fn form(records: &Records<'_>, line: Line<'_>) -> Result<Layout, ExchangeError> {
    let (complex, double) = match records.integer(line, 0, 10, "the type of the data")? {
        2 => (false, false),
        4 => (false, true),
        5 => (true, false),
        6 => (true, true),
        other => {
            let expected = "the type of the data 2, 4 (real), 5 or 6 (complex)";
            return Err(records.refused_at(line.number, expected, other));
        }
    };
    let claimed = records.integer(line, 10, 10, "the number of values")?;
    let count = usize::try_from(claimed).ok().filter(|count| *count > 0);
    let count = count.ok_or_else(|| {
        records.refused_at(line.number, "the number of values, from 1 up, in columns 11 to 20", claimed)
    })?;
    let even = match records.integer(line, 20, 10, "the spacing of the abscissa")? {
        0 => false,
        1 => true,
        other => {
            let expected = "the spacing of the abscissa 0 (uneven) or 1 (even)";
            return Err(records.refused_at(line.number, expected, other));
        }
    };
    Ok(Layout { count, complex, even, coding: if double { Coding::Double } else { Coding::Single } })
}

/// What the values along an axis are.
fn axis(records: &mut Records<'_>) -> Result<Axis, ExchangeError> {
    let line = records.record("the quantity of an axis")?;
    Ok(Axis {
        quantity: records.integer(line, 0, 10, "the quantity of an axis")?,
        label: text(line.bytes, 26, 20),
        unit: text(line.bytes, 47, 20),
    })
}
