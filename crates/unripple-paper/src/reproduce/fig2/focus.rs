//! The focus of either half of Fig. 2: what is asked of it, at the largest force.

use crate::reproduce::Bed;
use crate::reproduce::modes::FORCE;
use unripple::core::Responses;
use unripple::focus::{Focused, Options, Target, focus};
use unripple_tasks::TaskError;

/// The drive for one target on some responses, with the bed's window.
pub(super) fn focused(bed: &Bed, responses: &Responses, target: Target) -> Result<Focused, TaskError> {
    let options = Options { window: bed.window, limit: FORCE, ..Options::default() };
    focus(responses, &[target], &options).map_err(TaskError::work)
}
