//! Why a field could not be computed or measured.

use unripple_core::{CoreError, OutOfRange, Point};

/// Why a field could not be computed or measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// The channels of the drive are not the actuators of the responses, by name and order.
    #[error("channels: expected {expected}, found {found}")]
    Channels {
        /// Number of actuators, and their names.
        expected: String,
        /// Number of channels of the drive, and their names.
        found: String,
    },
    /// The drive and the responses have different sample rates.
    #[error("sample rate of the drive: expected {expected} Hz, as the responses have, found {found} Hz")]
    Rate {
        /// Rate of the responses, in Hz.
        expected: f64,
        /// Rate of the drive, in Hz.
        found: f64,
    },
    /// A point lies outside the surface.
    #[error("{at} is outside the surface, nearest legal point {nearest}")]
    Outside {
        /// The point requested.
        at: Point,
        /// The nearest point of the surface.
        nearest: Point,
    },
    /// A point lies too far from every point whose responses are known.
    #[error(
        "{at} is {:.3} mm from the nearest point with responses, expected at most {:.3} mm; \
         nearest legal point {nearest}", distance * 1e3, reach * 1e3
    )]
    Unknown {
        /// The point requested.
        at: Point,
        /// The nearest point with responses.
        nearest: Point,
        /// Distance from the requested point to the nearest one with responses, in metres.
        distance: f64,
        /// Largest distance allowed, in metres.
        reach: f64,
    },
    /// A requested instant lies outside the time in which the field is known.
    #[error(
        "instant: expected {:.4} ms to {:.4} ms, {why}, found {:.4} ms", first * 1e3, last * 1e3, found * 1e3
    )]
    Instant {
        /// The instant requested, in seconds.
        found: f64,
        /// The first instant allowed, in seconds.
        first: f64,
        /// The last instant allowed, in seconds.
        last: f64,
        /// The reason for the first and last instant allowed.
        why: &'static str,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A count (of samples, points or cells, for example) is out of its range.
    #[error("{what}: expected {expected}, found {found}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// The range of counts accepted, in words.
        expected: String,
        /// The count found.
        found: usize,
    },
    /// A drive or a set of responses is invalid: its sizes, sample rate or samples are not accepted.
    #[error(transparent)]
    Core(#[from] CoreError),
}
