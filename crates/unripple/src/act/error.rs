//! Why an act of focusing could not be carried out or evaluated.

use crate::field::FieldError;
use crate::focus::FocusError;
use crate::physics::PhysicsError;
use unripple_core::OutOfRange;

/// Why an act of focusing could not be carried out or evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ActError {
    /// The responses of the surface could not be computed.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// No drive could be made.
    #[error(transparent)]
    Focus(#[from] FocusError),
    /// What a drive does could not be computed or measured.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The level asked for makes no sense, or the drive limit does not give it.
    #[error("{what}: expected {expected}, found {found}")]
    Level {
        /// What was asked for.
        what: LevelKind,
        /// The legal values.
        expected: String,
        /// The value, or what stands in its way.
        found: String,
    },
    /// A number is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// No wave fits into so short a time.
    #[error(
        "expected at least {:.4} ms, one period at the top of the band ({top} Hz): nothing shorter carries a wave, found {:.4} ms",
        least * 1e3, found * 1e3
    )]
    Short {
        /// The shortest time, in seconds.
        least: f64,
        /// The top of the band, in Hz.
        top: f64,
        /// The time, in seconds.
        found: f64,
    },
    /// The responses are not of the form that is needed.
    #[error("responses: expected modes, which {what} needs, found samples")]
    NeedsModes {
        /// What needs them.
        what: &'static str,
    },
}

impl ActError {
    /// Whether the work failed although the input makes sense.
    pub fn is_failed_work(&self) -> bool {
        matches!(self, Self::Physics(PhysicsError::NotConverged { .. }) | Self::Short { .. })
    }
}

/// Kinds of levels that a drive can be brought to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelKind {
    /// By the peak displacement of the first target.
    Peak,
    /// By what is felt at the first target.
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
