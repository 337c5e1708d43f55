//! The errors of this crate.

use unripple_core::OutOfRange;

/// Why a signal or a plan was refused: a wrong size, or a number out of range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DspError {
    /// Two sizes that must agree do not.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// Name of the quantity that was counted.
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
