//! Errors of devices.

use unripple_core::{DeviceError, OutOfRange};
use unripple_physics::PhysicsError;

/// Errors of devices: of opening them, of their options, and of exchanging blocks ([`DeviceError`]).
#[derive(Debug, thiserror::Error)]
pub enum DevicesError {
    /// The surface of a virtual device is not valid.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// A block could not be exchanged.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A count, such as that of channels or samples, is not the one expected.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// What was counted.
        what: &'static str,
        /// The count expected.
        expected: usize,
        /// The number found.
        found: usize,
    },
    /// A device has too few channels.
    #[error("{device}: expected at least {expected} {what}, found {found}; {fix}")]
    Channels {
        /// Name of the device.
        device: String,
        /// Which channels were counted, such as playback ports.
        what: &'static str,
        /// Number of channels needed.
        expected: usize,
        /// The number found.
        found: usize,
        /// How to fix it, in words.
        fix: String,
    },
    /// More simultaneous taps than the virtual surface was made for.
    #[error("taps at once: expected at most {most}, found one more")]
    Taps {
        /// Largest number of simultaneous taps.
        most: usize,
    },
    /// No JACK server answers, or the server refused a request.
    #[error("JACK: {what}; {fix}")]
    Jack {
        /// What went wrong with the server, in words.
        what: String,
        /// How to fix it, in words.
        fix: String,
    },
    /// There is no such sound card, or the card refused a request.
    #[error("sound card: {what}; {fix}")]
    Card {
        /// What went wrong with the card, in words.
        what: String,
        /// How to fix it, in words.
        fix: String,
    },
}

/// Checks that two counts are equal.
pub(crate) fn same(what: &'static str, found: usize, expected: usize) -> Result<(), DevicesError> {
    if found == expected { Ok(()) } else { Err(DevicesError::Size { what, expected, found }) }
}
