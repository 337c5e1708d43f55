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
    /// Sizes do not agree.
    #[error("{what}: expected {expected}, found {found}")]
    Size {
        /// What is counted.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A device has too few channels.
    #[error("{device}: expected at least {expected} {what}, found {found}; {fix}")]
    Channels {
        /// The device's own name.
        device: String,
        /// Playback or capture ports, or what else is counted.
        what: &'static str,
        /// How many are needed.
        expected: usize,
        /// How many there are.
        found: usize,
        /// How to fix it.
        fix: String,
    },
    /// More taps at once than the virtual surface was made for.
    #[error("taps at once: expected at most {most}, found one more")]
    Taps {
        /// How many there may be.
        most: usize,
    },
    /// No sound server answers, or it refuses.
    #[error("JACK: {what}; {fix}")]
    Jack {
        /// What the server did or did not do.
        what: String,
        /// How to fix it.
        fix: String,
    },
    /// There is no such sound card, or it refuses.
    #[error("sound card: {what}; {fix}")]
    Card {
        /// What the card did or did not do.
        what: String,
        /// How to fix it.
        fix: String,
    },
}

/// A typed error unless two counts agree.
pub(crate) fn same(what: &'static str, found: usize, expected: usize) -> Result<(), DevicesError> {
    if found == expected { Ok(()) } else { Err(DevicesError::Size { what, expected, found }) }
}
