//! Why responses could not be made from what was measured.

use unripple_core::{CoreError, DeviceError, OutOfRange, Point};
use unripple_dsp::DspError;
use unripple_physics::PhysicsError;

/// Why responses could not be made from what was measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CalibrateError {
    /// A place lies outside the surface.
    #[error("place {}: {at} is outside the surface, nearest legal point {nearest}", place + 1)]
    Outside {
        /// Index of the place.
        place: usize,
        /// The place asked for.
        at: Point,
        /// The nearest point of the surface.
        nearest: Point,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A count is out of its range: of points, actuators or samples.
    #[error("{what}: expected {expected}, found {found}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// The legal counts.
        expected: String,
        /// How many there are.
        found: usize,
    },
    /// What is said of noise leaves a system that cannot be solved.
    #[error(
        "{points} points at {hz:.1} Hz: expected responses that the noise given can tell apart, found a singular system \
         (two points at one place, or too little noise)"
    )]
    Singular {
        /// Points of the system.
        points: usize,
        /// Frequency of the bin, in Hz.
        hz: f64,
    },
    /// The equations of a fit have no solution in the arithmetic there is.
    #[error("{what}: expected {expected}, found {found}")]
    Unsolvable {
        /// What was to be solved.
        what: &'static str,
        /// What there should be.
        expected: &'static str,
        /// What there is.
        found: String,
    },
    /// An actuator has no channel on the device.
    #[error(
        "actuator `{actuator}`: expected {actuators} outputs of `{device}`, one by that name, found {count} ({outputs}); {mend}"
    )]
    Wire {
        /// Name of the actuator.
        actuator: String,
        /// Name of the device.
        device: String,
        /// Actuators that there are.
        actuators: usize,
        /// Names of the outputs.
        outputs: String,
        /// Outputs that there are.
        count: usize,
        /// What would help.
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
    /// Whoever moves the probe or taps the surface could not.
    #[error("point {}: {why}", number + 1)]
    Rig {
        /// Index of the point.
        number: usize,
        /// What the rig reported.
        why: String,
    },
    /// What was measured could not be kept.
    #[error("point {}: {why}", number + 1)]
    Sink {
        /// Index of the point.
        number: usize,
        /// What the sink reported.
        why: String,
    },
    /// What was recorded is not what could be measured from.
    #[error("{what}: expected {expected}, found {found}")]
    Recording {
        /// What was recorded.
        what: String,
        /// What there should be.
        expected: String,
        /// What there is.
        found: String,
    },
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// Signals that do not fit.
    #[error(transparent)]
    Dsp(#[from] DspError),
    /// Responses were refused.
    #[error(transparent)]
    Core(#[from] CoreError),
    /// The physics of the nominal surface failed.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
}
