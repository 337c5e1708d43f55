//! Why no drive could be computed.

use unripple_core::{CoreError, OutOfRange, Point};
use unripple_dsp::DspError;

/// Why no drive could be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FocusError {
    /// A target lies outside the surface.
    #[error("target {}: {at} is outside the surface, nearest legal point {nearest}", target + 1)]
    Outside {
        /// Index of the target.
        target: usize,
        /// The point requested.
        at: Point,
        /// The nearest point of the surface.
        nearest: Point,
    },
    /// A target lies too far from every point whose responses are known.
    #[error(
        "target {}: {at} is {:.3} mm from the nearest point with responses, expected at most {:.3} mm; \
         nearest legal point {nearest}", target + 1, distance * 1e3, reach * 1e3
    )]
    Unknown {
        /// Index of the target.
        target: usize,
        /// The point requested.
        at: Point,
        /// The nearest point with responses.
        nearest: Point,
        /// Distance from the requested point to the nearest one with responses, in metres.
        distance: f64,
        /// The largest distance accepted, in metres.
        reach: f64,
    },
    /// No actuator moves the target: it lies on a fixed edge or on nodal lines.
    #[error(
        "target {}: no actuator can move {at} (on a held edge or a nodal line?), expected a point that moves", target + 1
    )]
    Still {
        /// Index of the target.
        target: usize,
        /// First point of the target.
        at: Point,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A count (of targets, points, actuators or samples, for example) is out of its range.
    #[error("{what}: expected {expected}, found {found}")]
    Count {
        /// What was counted.
        what: &'static str,
        /// The range of counts accepted, in words.
        expected: String,
        /// The count found.
        found: usize,
    },
    /// No method has this name.
    #[error("no method `{found}`: expected one of {expected}")]
    Method {
        /// The name requested.
        found: String,
        /// The names of all methods.
        expected: String,
    },
    /// The request needs modal responses, but the responses are sampled; the string names what needs modes.
    #[error("{0}: expected modal responses, found sampled ones")]
    NeedsModes(&'static str),
    /// Two targets are so close that their levels cannot differ.
    #[error(
        "targets {} and {}: expected places whose levels can differ, found no drive that gives them different levels", other + 1,
        target + 1
    )]
    Inseparable {
        /// Index of the target.
        target: usize,
        /// Index of an earlier target, to which this one is too close for different levels.
        other: usize,
    },
    /// A matrix computed from the responses is not positive definite, or its eigenvalues were not found.
    #[error("responses: expected a positive definite system of equations, found one that is not")]
    Decomposition,
    /// The iteration for [`Method::Limited`](crate::Method::Limited) did not converge.
    #[error("duality gap of the limited drive: expected at most {expected:e}, found {found:e}")]
    Gap {
        /// Largest duality gap accepted, as a share of the objective.
        expected: f64,
        /// Duality gap reached, as a share of the objective.
        found: f64,
    },
    /// The computed samples do not form a valid drive.
    #[error(transparent)]
    Core(#[from] CoreError),
    /// Matrices or signals of the responses have sizes that do not match, or a number is out of its range.
    #[error(transparent)]
    Dsp(#[from] DspError),
}
