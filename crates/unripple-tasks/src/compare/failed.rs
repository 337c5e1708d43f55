//! Methods and surfaces of a comparison that failed, and why.

use crate::TaskError;
use serde::Serialize;
use unripple::focus::Method;

/// A focusing method that failed, and why.
#[derive(Clone, Debug, Serialize)]
pub struct Failed {
    /// Name of the method.
    pub method: &'static str,
    /// Reason of the failure; for a tradeoff curve it names the value of the method's parameter.
    pub why: String,
}

/// A surface on which nothing could be compared, and why.
#[derive(Clone, Debug, Serialize)]
pub struct FailedSurface {
    /// Name of the surface in the comparison.
    pub label: String,
    /// Reason of the failure, such as a target outside the surface.
    pub why: String,
}

/// Result of a method; `None` if it failed, in which case its error is added to `failed`.
///
/// # Errors
/// [`TaskError::Cancelled`].
pub(super) fn survived<T>(
    found: Result<T, TaskError>,
    method: Method,
    failed: &mut Vec<Failed>,
) -> Result<Option<T>, TaskError> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(TaskError::Cancelled) => Err(TaskError::Cancelled),
        Err(error) => {
            failed.push(Failed { method: method.name(), why: error.to_string() });
            Ok(None)
        }
    }
}
