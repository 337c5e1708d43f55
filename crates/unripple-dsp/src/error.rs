//! Why a signal or a plan could not be made.

use unripple_core::OutOfRange;

/// Why a signal or a plan could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DspError {
    /// Two sizes that must agree do not.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// What was counted.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
}
