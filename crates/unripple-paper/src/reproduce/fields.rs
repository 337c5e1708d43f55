//! What is taken from fields: grids, the only target's figures, largest magnitudes.

use unripple::field::{Field, Grid, TargetFigures};
use unripple_tasks::TaskError;

/// The grid of a field made from modes.
pub(super) fn cells(field: &Field) -> Result<Grid, TaskError> {
    field.grid().cloned().ok_or_else(|| TaskError::Work("the field has no grid to draw".into()))
}

/// Largest magnitude of some values, in their own unit; 0 without any.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// The only target's figures.
pub(super) fn first(targets: Vec<TargetFigures>) -> Result<TargetFigures, TaskError> {
    targets.into_iter().next().ok_or_else(|| TaskError::Work("no target was measured".into()))
}
