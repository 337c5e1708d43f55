//! The errors of this crate.

use unripple_core::OutOfRange;

/// Why a set of effects, or a call on it, was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EffectsError {
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// There are too many or too few of something.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// Name of what is counted.
        what: &'static str,
        /// The allowed number or range of numbers, in words.
        expected: String,
        /// The number found.
        found: usize,
    },
    /// The abscissae of a curve's points are not in ascending order.
    #[error("{what}: expected points in ascending order, found {found} after {before}")]
    Order {
        /// Name of the curve's abscissa.
        what: &'static str,
        /// The abscissa of a point.
        before: f64,
        /// The smaller abscissa of the next point.
        found: f64,
    },
    /// Two effects of a set have the same name.
    #[error("effect names: expected each once, found `{name}` twice")]
    Twice {
        /// The name that both effects have.
        name: String,
    },
    /// An edge effect has neither a line nor a region with a border, so that it could never be felt.
    #[error("edge `{name}`: expected a line, or a region with a border, found neither")]
    Nowhere {
        /// Name of the effect.
        name: String,
    },
    /// The set has no score of this name that is started by name.
    #[error("expected a score that is started by name, one of {expected}, found `{found}`")]
    NoScore {
        /// The names of the scores that can be started by name.
        expected: String,
        /// The name that was requested.
        found: String,
    },
}

/// Refuses a value outside its limits, all in the same unit.
pub(crate) fn within(
    what: &'static str,
    found: f64,
    [least, greatest]: [f64; 2],
) -> Result<(), EffectsError> {
    if (least..=greatest).contains(&found) {
        return Ok(());
    }
    Err(EffectsError::Range(OutOfRange::new(what, format!("a number from {least} to {greatest}"), found)))
}

/// Refuses a count outside its limits.
pub(crate) fn counted(
    what: &'static str,
    found: usize,
    least: usize,
    most: usize,
) -> Result<(), EffectsError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(EffectsError::Size { what, expected: format!("{least} to {most}"), found })
}

/// Refuses a place (m) outside [`crate::limits::PLACE`].
pub(crate) fn place(what: &'static str, at: unripple_core::Point) -> Result<(), EffectsError> {
    within(what, at.x, crate::limits::PLACE)?;
    within(what, at.y, crate::limits::PLACE)
}
