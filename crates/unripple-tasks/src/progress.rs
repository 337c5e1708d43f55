//! How far a task is, and whether it is still wanted.

use crate::TaskError;

/// Hears how far a task is, and says whether it is still wanted.
///
/// ```
/// use unripple_tasks::{Progress, TaskError, design};
///
/// /// Whoever waits has gone.
/// struct Gone;
///
/// impl Progress for Gone {
///     fn cancelled(&self) -> bool {
///         true
///     }
/// }
///
/// assert!(matches!(design::run(&design::Ask::default(), &mut Gone), Err(TaskError::Cancelled)));
/// ```
pub trait Progress {
    /// A stage begins: what is done in it, for people.
    fn stage(&mut self, _what: &str) {}

    /// How much of the stage is done, from 0 to 1.
    fn done(&mut self, _share: f64) {}

    /// A line that people should read now, such as a warning.
    fn tell(&mut self, _line: &str) {}

    /// Whether nobody waits for the task any more. Every long loop looks here.
    fn cancelled(&self) -> bool {
        false
    }

    /// Does what cannot be taken back, as putting results in their place, unless the task is cancelled: whoever cancels it finds all of
    /// it or nothing.
    ///
    /// # Errors
    /// [`TaskError::Cancelled`], and those of `put`.
    fn place(&mut self, put: &mut dyn FnMut() -> Result<(), TaskError>) -> Result<(), TaskError> {
        if self.cancelled() { Err(TaskError::Cancelled) } else { put() }
    }
}

/// Nobody listens, and the task goes on to its end.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {}

/// An error once nobody waits for the task any more.
///
/// # Errors
/// [`TaskError::Cancelled`].
pub fn go_on(progress: &dyn Progress) -> Result<(), TaskError> {
    if progress.cancelled() { Err(TaskError::Cancelled) } else { Ok(()) }
}
