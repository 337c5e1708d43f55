//! Checks of numbers in requests, made before any work is done.

use crate::TaskError;

/// Returns `value` if it is finite and above 0, else an error that names its field and unit.
///
/// # Errors
/// [`TaskError::Ask`] of any other number.
pub fn above_zero(value: f64, field: &'static str, unit: &str) -> Result<f64, TaskError> {
    match value.is_finite() && value > 0.0 {
        true => Ok(value),
        false => Err(TaskError::ask(field, format!("a number above 0 {unit}"), value)),
    }
}

/// Name of the field for the relative accuracy of natural frequencies, in requests and in surface files.
pub const ACCURACY: &str = "accuracy";

/// Returns `value` if the solvers of modes accept it as a relative accuracy of natural frequencies, else an
/// error that names the field.
///
/// # Errors
/// [`TaskError::Ask`] of any other number.
pub fn accuracy(value: f64) -> Result<f64, TaskError> {
    match (1e-12..=0.1).contains(&value) {
        true => Ok(value),
        false => Err(TaskError::ask(ACCURACY, "a ratio from 1e-12 to 0.1", value)),
    }
}
