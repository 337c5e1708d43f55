//! Why a focus could not be computed or evaluated.

use crate::field::FieldError;
use crate::focus::FocusError;
use crate::physics::PhysicsError;
use unripple_core::OutOfRange;

/// Why a focus could not be computed or evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ActError {
    /// The responses of the surface could not be computed.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// No drive could be computed.
    #[error(transparent)]
    Focus(#[from] FocusError),
    /// The field of a drive could not be computed or evaluated.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The requested level is not a legal number, is above that of the drive at its limit, or cannot be
    /// reached.
    #[error("{what}: expected {expected}, found {found}")]
    Level {
        /// Kind of the requested level.
        what: LevelKind,
        /// The legal values.
        expected: String,
        /// The requested value, or why it cannot be reached.
        found: String,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// A duration is shorter than one period at the top of the band, so that it carries no wave.
    #[error(
        "expected at least {:.4} ms, one period at the top of the band ({top} Hz): nothing shorter carries a wave, found {:.4} ms",
        least * 1e3, found * 1e3
    )]
    Short {
        /// The shortest duration allowed, in seconds.
        least: f64,
        /// The top of the band, in Hz.
        top: f64,
        /// The duration that is too short, in seconds.
        found: f64,
    },
    /// The band of the surface has no mode, so that nothing resonates in it.
    #[error("drive.band_hz: expected modes within {} to {} Hz, found none{}", band[0], band[1], above(*next))]
    Empty {
        /// The band, lowest and highest frequency in Hz.
        band: [f64; 2],
        /// The lowest mode above the band, in Hz, if it is known.
        next: Option<f64>,
    },
    /// Modal responses are needed, and these are sampled.
    #[error("responses: expected modes, which {what} needs, found samples")]
    NeedsModes {
        /// The computation that needs modal responses.
        what: &'static str,
    },
}

/// Where the next mode above a band is, for messages.
fn above(next: Option<f64>) -> String {
    next.map_or_else(String::new, |hz| format!(" (the next mode is at {hz:.1} Hz)"))
}

impl ActError {
    /// Whether the computation failed on legal input: it did not converge, or a duration is too short for the band.
    pub fn is_failed_work(&self) -> bool {
        matches!(self, Self::Physics(PhysicsError::NotConverged { .. }) | Self::Short { .. })
    }
}

/// Kinds of levels that a drive can be brought to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelKind {
    /// Peak displacement of the first target.
    Peak,
    /// Felt level at the first target, in dB above the threshold of touch.
    Felt,
}

impl std::fmt::Display for LevelKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Peak => "peak displacement",
            Self::Felt => "level as felt",
        })
    }
}
