//! The errors of a search for places.

use unripple_core::{OutOfRange, Point};
use unripple_field::FieldError;
use unripple_physics::PhysicsError;

/// Why places for actuators could not be found or evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlacementError {
    /// A value is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// The responses of a surface could not be computed.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// The grid of the field could not be made.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// There are too few places for the actuators.
    #[error("places for actuators: expected at least {expected}, found {found}")]
    Few {
        /// Number of places that are needed.
        expected: usize,
        /// Number of places that the rules leave, of those that are far enough from each other.
        found: usize,
    },
    /// At a target nothing can be in focus.
    #[error("target at {at}: expected {expected}, found none")]
    Target {
        /// The target, in metres.
        at: Point,
        /// What a target needs, in words.
        expected: &'static str,
    },
    /// No mode lies in the band.
    #[error("modes in the band: expected at least 1, found 0")]
    Empty,
    /// No measurement tells of some unknowns, or of some combination of them.
    #[error(
        "measurements at all {places} places together: expected to tell of all {unknowns} unknowns and their combinations, found some of \
         which nothing is known"
    )]
    Untold {
        /// Number of places.
        places: usize,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// The search needs more memory than is allowed.
    #[error(
        "a search among {places} places on {cases} targets: expected at most {limit_gib:.2} GiB, found {needed_gib:.2} GiB; a larger \
         pitch of the places or fewer targets need less"
    )]
    TooLarge {
        /// Number of places.
        places: usize,
        /// Number of targets, each counted once per model of the surface.
        cases: usize,
        /// The memory that the search needs, in GiB.
        needed_gib: f64,
        /// The memory allowed, in GiB.
        limit_gib: f64,
    },
}
