//! The errors of this crate.

use unripple_core::OutOfRange;

/// Why a signal or a plan was refused: a wrong size, or a number out of range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DspError {
    /// Two sizes that must be equal differ.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// Name of what was counted.
        what: &'static str,
        /// The required number.
        expected: usize,
        /// The number that was found.
        found: usize,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
}
