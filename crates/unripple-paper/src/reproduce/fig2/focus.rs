//! The focus for both halves of Fig. 2, with the largest force that the figures share.

use crate::reproduce::PaperSetup;
use crate::reproduce::modes::FORCE;
use unripple::core::Responses;
use unripple::focus::{Focused, Options, Target, focus};
use unripple_tasks::TaskError;

/// Computes the drive for one target from `responses`, with the paper's window.
pub(super) fn focused(
    setup: &PaperSetup,
    responses: &Responses,
    target: Target,
) -> Result<Focused, TaskError> {
    let options = Options { window: setup.window, limit: FORCE, ..Options::default() };
    focus(responses, &[target], &options).map_err(TaskError::work)
}
