//! The errors of this crate.

use crate::OutOfRange;

/// Why a value of this crate was refused: a wrong size, or a number that is not finite or out of range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CoreError {
    /// Two sizes that must be equal differ.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// Name of what was counted, such as `response samples`.
        what: &'static str,
        /// The required number.
        expected: usize,
        /// The number that was found.
        found: usize,
    },
    /// A sample is infinite or not a number.
    #[error("{what}: expected a finite number, found {found} at sample {sample} of channel `{channel}`")]
    NotFinite {
        /// What the sample belongs to, such as `drive`.
        what: &'static str,
        /// Name of the channel that holds the sample.
        channel: String,
        /// Index of the sample in its channel.
        sample: usize,
        /// The value that was found.
        found: f64,
    },
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
}
