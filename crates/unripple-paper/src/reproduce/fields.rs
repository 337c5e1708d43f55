//! Data taken from fields: the grid, the metrics of a single target, and largest magnitudes.

use unripple::field::{Field, Grid, TargetFigures};
use unripple_tasks::TaskError;

/// The grid of a field, or an error if it has none, as a field of sampled responses.
pub(super) fn cells(field: &Field) -> Result<Grid, TaskError> {
    field.grid().cloned().ok_or_else(|| TaskError::Work("the field has no grid to draw".into()))
}

/// Largest magnitude of `values`, in their unit; 0 if there are none.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// Metrics of the only target, or an error if there is none.
pub(super) fn first(targets: Vec<TargetFigures>) -> Result<TargetFigures, TaskError> {
    targets.into_iter().next().ok_or_else(|| TaskError::Work("no target was measured".into()))
}
