//! Why a value of this crate could not be made.

use crate::OutOfRange;

/// Why a core value could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CoreError {
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
    /// A value that must be finite is not.
    #[error("{what}: expected a finite number, found {found} at sample {sample} of channel `{channel}`")]
    NotFinite {
        /// What holds the value.
        what: &'static str,
        /// Name of the channel that holds it.
        channel: String,
        /// Index of the sample.
        sample: usize,
        /// The value that was found.
        found: f64,
    },
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
}
