//! Progress reports of tasks, and their cancellation.

use crate::TaskError;
use std::sync::Arc;
use unripple::core::{Cache, Cached, Observed, Observer};

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
    /// Reports that a stage of the task begins; `_what` describes the stage in words.
    fn stage(&mut self, _what: &str) {}

    /// Reports the share of the stage that is done, from 0 to 1.
    fn done(&mut self, _share: f64) {}

    /// Reports that the last stage is over; from then on the task runs until its user stops it, as when
    /// playing.
    fn over(&mut self) {}

    /// Shows the user a line of text immediately, such as a warning.
    fn tell(&mut self, _line: &str) {}

    /// Observer to which long computations within a stage report their parts and progress, from any thread,
    /// while [`observed`] runs the task; `None` by default. The parts of a stage are shown with its name
    /// before them.
    fn observer(&self) -> Option<Arc<dyn Observer>> {
        None
    }

    /// Cache in which long computations find the results of earlier ones, while [`observed`] runs the task; `None` by default.
    fn cache(&self) -> Option<Arc<dyn Cache>> {
        None
    }

    /// Whether the task has been cancelled. Every long loop asks this.
    fn cancelled(&self) -> bool {
        false
    }

    /// Runs `put`, an action that cannot be undone, such as moving results to their place, unless the task
    /// has been cancelled. A cancellation never leaves it done in part.
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

/// Runs `work` so that its long computations, such as meshing or solving for eigenvalues, report their
/// progress to [the observer](Progress::observer), find earlier results in [the cache](Progress::cache), if there is one, and take no more
/// [memory](crate::machine::memory) than the machine has.
pub fn observed<T>(progress: &mut dyn Progress, work: impl FnOnce(&mut dyn Progress) -> T) -> T {
    let (observed, cached) = (Observed::by(progress.observer()), Cached::by(progress.cache()));
    crate::machine::memory().during(|| observed.during(|| cached.during(|| work(progress))))
}

/// Text that names a part of a stage, as `stage: part`, or the part alone if `stage` is empty.
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
