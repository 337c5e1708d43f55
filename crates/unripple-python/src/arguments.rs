//! Arguments from Python that may be anything: what cannot be used is an `AskError` that names the argument.

use crate::error::ask;
use pyo3::prelude::*;
use std::ops::RangeInclusive;
use unripple::core::{Outline, Point};

/// Largest number of characters of a value in a message. Twice as many fill two lines with one value.
const SHOWN: usize = 80;

/// A whole number within a range.
pub(crate) fn whole(
    value: &Bound<'_, PyAny>,
    name: &'static str,
    range: RangeInclusive<u64>,
) -> PyResult<u64> {
    let found = value.extract::<u64>().ok().filter(|number| range.contains(number));
    found.ok_or_else(|| {
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        ask(value.py(), name, expected, shown(value))
    })
}

/// A finite number.
pub(crate) fn finite(value: &Bound<'_, PyAny>, name: &'static str) -> PyResult<f64> {
    let found = value.extract::<f64>().ok().filter(|number| number.is_finite());
    found.ok_or_else(|| ask(value.py(), name, "a finite number", shown(value)))
}

/// A number above 0.
pub(crate) fn positive(value: &Bound<'_, PyAny>, name: &'static str) -> PyResult<f64> {
    let found = finite(value, name)?;
    if found > 0.0 { Ok(found) } else { Err(ask(value.py(), name, "a number above 0", found)) }
}

/// A place on a surface, from x and y in metres.
pub(crate) fn place(value: &Bound<'_, PyAny>, name: &'static str, outline: &Outline) -> PyResult<Point> {
    let found = value.extract::<[f64; 2]>();
    let [x, y] = found.map_err(|_| ask(value.py(), name, "two numbers, x and y in m", shown(value)))?;
    on_surface(value.py(), Point::new(x, y), name, outline)
}

/// A place, in metres, if it is on a surface.
pub(crate) fn on_surface(
    py: Python<'_>,
    at: Point,
    name: &'static str,
    outline: &Outline,
) -> PyResult<Point> {
    if !at.is_finite() {
        return Err(ask(py, name, "finite coordinates in m", format!("({}, {})", at.x, at.y)));
    }
    if !outline.contains(at) {
        let found = format!("{at}; nearest is {}", outline.nearest(at));
        return Err(ask(py, name, "a place on the surface", found));
    }
    Ok(at)
}

/// A value as Python shows it, shortened.
pub(crate) fn shown(value: &Bound<'_, PyAny>) -> String {
    let text = value.repr().map_or_else(|_| "what cannot be shown".into(), |text| text.to_string());
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}
