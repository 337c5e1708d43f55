//! Why a set of effects cannot be used.

use unripple_core::OutOfRange;

/// Why a set of effects cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EffectsError {
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// There are too many or too few of something.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// What is counted.
        what: &'static str,
        /// How many there may be.
        expected: String,
        /// How many there are.
        found: usize,
    },
    /// The points of a curve run backwards.
    #[error("{what}: expected points in ascending order, found {found} after {before}")]
    Order {
        /// What runs along the curve, for messages.
        what: &'static str,
        /// The larger one that comes first.
        before: f64,
        /// The smaller one after it.
        found: f64,
    },
    /// Two effects have one name.
    #[error("effect names: expected each once, found `{name}` twice")]
    Twice {
        /// The name that both have.
        name: String,
    },
    /// An edge is felt nowhere.
    #[error("edge `{name}`: expected a line, or a region with a border, found neither")]
    Nowhere {
        /// Name of the effect.
        name: String,
    },
    /// No score of a set is started by that name.
    #[error("expected a score that is started by name, one of {expected}, found `{found}`")]
    NoScore {
        /// The names there are.
        expected: String,
        /// The name asked for.
        found: String,
    },
}

/// A typed error unless a value is within limits, in the same unit.
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

/// A typed error unless a count is within limits.
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

/// A typed error unless a place (m) is on some surface.
pub(crate) fn place(what: &'static str, at: unripple_core::Point) -> Result<(), EffectsError> {
    within(what, at.x, crate::limits::PLACE)?;
    within(what, at.y, crate::limits::PLACE)
}
