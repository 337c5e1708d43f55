//! Lists the devices of this machine.

use super::{Ask, Report};
use crate::{Progress, TaskError, go_on};
use unripple_devices::list;

/// Lists the devices through which drives can be played: the virtual surface, files, a sound server, cards.
///
/// # Errors
/// [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    go_on(progress)?;
    Ok(Report::of(&list(ask.server.as_deref())))
}
