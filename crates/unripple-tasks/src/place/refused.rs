//! Errors of a search for places, with the names of the fields that set what was refused.

use crate::{TaskError, machine};
use unripple::physics::PhysicsError;
use unripple_placement::PlacementError;

/// The error of a task for one of a search.
pub(super) fn refused(error: PlacementError) -> TaskError {
    match error {
        PlacementError::Physics(error @ PhysicsError::TooLarge { .. }) => {
            TaskError::Memory(machine::told(&error))
        }
        error @ PlacementError::TooLarge { .. } => TaskError::Memory(error.to_string()),
        PlacementError::Few { expected, found } => TaskError::ask(
            "count, apart_m",
            format!("room for {expected} actuators"),
            format!("room for {found}"),
        ),
        error => TaskError::input(error),
    }
}
