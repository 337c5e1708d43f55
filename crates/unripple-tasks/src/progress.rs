//! Progress reports of tasks, and their cancellation.

use crate::TaskError;
use std::sync::Arc;
use unripple::core::{Observed, Observer};

/// Callbacks that a task calls to report its progress, and to ask whether it has been cancelled.
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
    /// Reports that a stage begins; `_what` says in words what is done in it.
    fn stage(&mut self, _what: &str) {}

    /// Reports the share of the stage that is done, from 0 to 1.
    fn done(&mut self, _share: f64) {}

    /// Reports that the last stage is over and none follows: the task now lasts as long as people like, such as playing.
    fn over(&mut self) {}

    /// Shows people a line at once, such as a warning.
    fn tell(&mut self, _line: &str) {}

    /// Whom long computations within a stage tell their parts and shares, from any thread, where [`observed`] runs the task; nobody by
    /// default. The parts of a stage are shown with its name before them.
    fn observer(&self) -> Option<Arc<dyn Observer>> {
        None
    }

    /// Whether the task has been cancelled. Every long loop asks this.
    fn cancelled(&self) -> bool {
        false
    }

    /// Performs `put`, which cannot be undone, such as moving results to their place, unless the task has been cancelled. After a
    /// cancellation either all of it is done or nothing.
    ///
    /// # Errors
    /// [`TaskError::Cancelled`], and those of `put`.
    fn place(&mut self, put: &mut dyn FnMut() -> Result<(), TaskError>) -> Result<(), TaskError> {
        if self.cancelled() { Err(TaskError::Cancelled) } else { put() }
    }
}

/// Progress that shows nothing and never cancels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {}

/// Does work whose long computations tell the progress of their parts, as far as it has [an observer](Progress::observer): the meshes of an
/// outline, the shares of a spectrum.
pub fn observed<T>(progress: &mut dyn Progress, work: impl FnOnce(&mut dyn Progress) -> T) -> T {
    let observed = Observed::by(progress.observer());
    observed.during(|| work(progress))
}

/// A part of a stage, in words.
pub fn part_of(stage: &str, part: &str) -> String {
    if stage.is_empty() { part.to_owned() } else { format!("{stage}: {part}") }
}

/// Returns an error if the task has been cancelled.
///
/// # Errors
/// [`TaskError::Cancelled`].
pub fn go_on(progress: &dyn Progress) -> Result<(), TaskError> {
    if progress.cancelled() { Err(TaskError::Cancelled) } else { Ok(()) }
}
