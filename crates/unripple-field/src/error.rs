//! Why a field could not be computed or measured.

use unripple_core::{CoreError, OutOfRange, Point};

/// Why a field could not be computed or measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// The channels of the drive are not the actuators of the responses, by name and order.
    #[error("channels: expected {expected}, found {found}")]
    Channels {
        /// How many actuators, and their names.
        expected: String,
        /// How many channels, and their names.
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
        /// The point asked for.
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
        /// The point asked for.
        at: Point,
        /// The nearest point with responses.
        nearest: Point,
        /// Distance between the two, in metres.
        distance: f64,
        /// Largest distance allowed, in metres.
        reach: f64,
    },
    /// An instant is asked for at which the field is not known.
    #[error(
        "instant: expected {:.4} ms to {:.4} ms, {why}, found {:.4} ms", first * 1e3, last * 1e3, found * 1e3
    )]
    Instant {
        /// The instant asked for, in seconds.
        found: f64,
        /// The first instant allowed, in seconds.
        first: f64,
        /// The last instant allowed, in seconds.
        last: f64,
        /// What sets these bounds.
        why: &'static str,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A count is out of its range: of samples, points or cells.
    #[error("{what}: expected {expected}, found {found}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// The legal counts.
        expected: String,
        /// How many there are.
        found: usize,
    },
    /// A drive or a set of responses could not be made: sizes, rate or samples do not fit.
    #[error(transparent)]
    Core(#[from] CoreError),
}
