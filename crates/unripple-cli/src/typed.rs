//! Values of options by their text forms; errors name the option.

use crate::error::CliError;
use unripple_tasks::Place;
use unripple_tasks::text_forms::{self, FormError};

/// What was read of the value of an option.
pub fn of<T>(option: &str, read: Result<T, FormError>) -> Result<T, CliError> {
    read.map_err(|error| CliError::Input(error.of(option)))
}

/// What `form` reads of each value of a repeatable option, in the order typed.
pub fn each<T>(
    typed: &[String],
    option: &str,
    form: fn(&str) -> Result<T, FormError>,
) -> Result<Vec<T>, CliError> {
    of(option, typed.iter().map(|text| form(text)).collect())
}

/// Places `X,Y` in millimetres; gives them in metres.
pub fn places(typed: &[String], option: &str) -> Result<Vec<Place>, CliError> {
    each(typed, option, text_forms::place)
}

/// Checks that a number is above 0; the error names its option and unit.
pub fn positive(value: f64, option: &str, unit: &str) -> Result<f64, CliError> {
    of(option, text_forms::above_zero(value, unit))
}

/// Converts a time above 0 from milliseconds to seconds.
pub fn seconds(ms: Option<f64>, option: &str) -> Result<Option<f64>, CliError> {
    milli(ms, option, "ms")
}

/// Converts a length above 0 from millimetres to metres.
pub fn metres(mm: Option<f64>, option: &str) -> Result<Option<f64>, CliError> {
    milli(mm, option, "mm")
}

/// Converts a number above 0 from `unit`, a thousandth of an SI unit, to the SI unit.
pub fn milli(value: Option<f64>, option: &str, unit: &str) -> Result<Option<f64>, CliError> {
    value.map(|value| Ok(positive(value, option, unit)? / 1e3)).transpose()
}
