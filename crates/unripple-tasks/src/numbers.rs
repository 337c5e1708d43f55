//! Checks of numbers in asks, made before any work is done.

use crate::TaskError;

/// A finite number above 0, or an error that names its field and unit.
///
/// # Errors
/// [`TaskError::Ask`] of any other number.
pub fn above_zero(value: f64, field: &'static str, unit: &str) -> Result<f64, TaskError> {
    match value.is_finite() && value > 0.0 {
        true => Ok(value),
        false => Err(TaskError::ask(field, format!("a number above 0 {unit}"), value)),
    }
}
