//! Why drives, filters or a player could not be made.

use unripple_core::{OutOfRange, require};

/// Why drives, filters or a player could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlayerError {
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// Two sizes that must agree do not.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// Name of the size that differs.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A sample is not finite, or its magnitude is above 1e12.
    #[error(
        "{what}, sample {sample} of channel {channel}: expected a finite number within ±1e12, found {found}"
    )]
    Sample {
        /// What the sample belongs to.
        what: &'static str,
        /// Index of the channel, from 0.
        channel: usize,
        /// Index of the sample, from 0.
        sample: usize,
        /// The value that was found.
        found: f32,
    },
}

/// Largest magnitude of a sample that is accepted: the product of two such samples is still far within the
/// range of float32.
pub(crate) const HUGE: f32 = 1e12;

/// A typed error unless a count is within its bounds.
pub(crate) fn count(what: &'static str, found: usize, least: usize, most: usize) -> Result<(), PlayerError> {
    Ok(require(what, (least..=most).contains(&found), format!("{least} to {most}"), found as f64)?)
}

/// A typed error unless two numbers of things agree.
pub(crate) fn same(what: &'static str, found: usize, expected: usize) -> Result<(), PlayerError> {
    if found == expected { Ok(()) } else { Err(PlayerError::Size { what, expected, found }) }
}

/// A typed error unless every sample of planar channels can be played.
pub(crate) fn playable(what: &'static str, data: &[f32], samples: usize) -> Result<(), PlayerError> {
    match data.iter().position(|x| !x.is_finite() || x.abs() > HUGE) {
        None => Ok(()),
        Some(at) => {
            let samples = samples.max(1);
            Err(PlayerError::Sample { what, channel: at / samples, sample: at % samples, found: data[at] })
        }
    }
}
