//! A number that is refused because it is out of its range.

use std::borrow::Cow;

/// A number is out of its range.
///
/// ```
/// use unripple_core::require;
///
/// let error = require("window (s)", false, "a positive number", -0.03).unwrap_err();
/// assert_eq!(error.to_string(), "window (s): expected a positive number, found -0.03");
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what}: expected {expected}, found {found}")]
pub struct OutOfRange {
    /// Name of the quantity, with its unit, such as `window (s)`.
    pub what: Cow<'static, str>,
    /// The legal values, in words for people.
    pub expected: Cow<'static, str>,
    /// The value that was found.
    pub found: f64,
}

impl OutOfRange {
    /// The error for a number `found`, in the unit that `what` names, outside the allowed values `expected`.
    pub fn new(
        what: impl Into<Cow<'static, str>>,
        expected: impl Into<Cow<'static, str>>,
        found: f64,
    ) -> Self {
        Self { what: what.into(), expected: expected.into(), found }
    }
}

/// Checks a number: `Ok` if `legal` is true and `found` is finite, else an error that names the quantity
/// `what` and the values `expected`.
///
/// # Errors
/// [`OutOfRange`], with what was expected and what was found.
pub fn require(
    what: impl Into<Cow<'static, str>>,
    legal: bool,
    expected: impl Into<Cow<'static, str>>,
    found: f64,
) -> Result<(), OutOfRange> {
    if legal && found.is_finite() { Ok(()) } else { Err(OutOfRange::new(what, expected, found)) }
}
