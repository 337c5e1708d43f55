//! Errors of a search for places, with the names of the fields that set what was refused.

use crate::TaskError;
use unripple_placement::PlacementError;

/// The error of a task for one of a search.
pub(super) fn refused(error: PlacementError) -> TaskError {
    match error {
        PlacementError::Physics(error) => error.into(),
        error @ PlacementError::TooLarge { .. } => TaskError::Memory(error.to_string()),
        PlacementError::Few { expected, found } => TaskError::ask(
            "count, apart_m",
            format!("room for {expected} actuators"),
            format!("room for {found}"),
        ),
        error => TaskError::input(error),
    }
}
