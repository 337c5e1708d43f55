//! Errors of measuring, interpolating and fitting responses.

use unripple_core::{CoreError, DeviceError, OutOfRange, Point};
use unripple_dsp::DspError;
use unripple_physics::PhysicsError;

/// Error of measuring, interpolating or fitting responses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CalibrateError {
    /// A place lies outside the surface.
    #[error("place {}: {at} is outside the surface, nearest legal point {nearest}", place + 1)]
    Outside {
        /// Index of the place, from 0.
        place: usize,
        /// The place requested.
        at: Point,
        /// The nearest point of the surface.
        nearest: Point,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A count (of points, actuators or samples, for example) is out of its range.
    #[error("{what}: expected {expected}, found {found}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// The range of counts accepted, in words.
        expected: String,
        /// The count found.
        found: usize,
    },
    /// The kriging equations cannot be solved: their covariance matrix is not positive definite.
    #[error(
        "{points} points at {hz:.1} Hz: expected responses that the noise given can tell apart, found a singular system \
         (two points at one place, or too little noise)"
    )]
    Singular {
        /// Number of points in the system of equations.
        points: usize,
        /// Frequency of the bin, in Hz.
        hz: f64,
    },
    /// A quantity cannot be determined, since its equations have no solution in floating-point arithmetic.
    #[error("{what}: expected {expected}, found {found}")]
    Unsolvable {
        /// Quantity that was to be determined.
        what: &'static str,
        /// What the solution requires, in words.
        expected: &'static str,
        /// What was found instead.
        found: String,
    },
    /// An actuator has no output channel on the device.
    #[error(
        "actuator `{actuator}`: expected {actuators} outputs of `{device}`, one by that name, found {count} ({outputs}); {mend}"
    )]
    Wire {
        /// Name of the actuator.
        actuator: String,
        /// Name of the device.
        device: String,
        /// Number of actuators of the surface.
        actuators: usize,
        /// Names of the device's outputs.
        outputs: String,
        /// Number of the device's outputs.
        count: usize,
        /// How to correct this, in words.
        mend: String,
    },
    /// A device lost blocks during a recording.
    #[error("device `{device}`: expected a recording without gaps, found {lost} blocks lost")]
    Gap {
        /// Name of the device.
        device: String,
        /// Number of blocks lost.
        lost: u64,
    },
    /// The rig, which moves the probe or taps the surface, reported a failure.
    #[error("point {}: {why}", number + 1)]
    Rig {
        /// Index of the point.
        number: usize,
        /// What the rig reported.
        why: String,
    },
    /// Measured responses could not be stored.
    #[error("point {}: {why}", number + 1)]
    Sink {
        /// Index of the point.
        number: usize,
        /// What the sink reported.
        why: String,
    },
    /// A recording, or the device it comes from, is not suitable for measuring responses.
    #[error("{what}: expected {expected}, found {found}")]
    Recording {
        /// Part of the recording or device that is not suitable.
        what: String,
        /// What was expected of that part, in words.
        expected: String,
        /// What was found instead.
        found: String,
    },
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// Signal processing failed.
    #[error(transparent)]
    Dsp(#[from] DspError),
    /// Responses are not valid.
    #[error(transparent)]
    Core(#[from] CoreError),
    /// The physics of the nominal surface failed.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
}
