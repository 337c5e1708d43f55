//! Flags by which the session cancels work on other threads.

use crate::ViewError;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;
use unripple::core::Cache;
use unripple::core::clock::Instant;
use unripple_tasks::Progress;

/// How long work may take in all once newer work waits. Most surfaces are computed in that time, so that
/// results still follow a slider that is dragged; what takes longer would keep the newest surface waiting.
const PATIENCE: Duration = Duration::from_secs(2);

/// What the session may say of work, each more urgent than the one before.
const GO_ON: u8 = 0;
const HURRY: u8 = 1;
const STOP: u8 = 2;

/// The session's handle of work on another thread. The work is cancelled when the handle is dropped.
#[derive(Debug, Default)]
pub struct Underway(Stop);

impl Underway {
    /// The cancellation flag, to be passed to the work.
    pub fn stop(&self) -> Stop {
        self.0.clone()
    }

    /// Cancels the work at once.
    pub fn give_up(&self) {
        self.0.0.fetch_max(STOP, Ordering::Relaxed);
    }

    /// Cancels the work if it takes longer than two seconds in all, because newer work waits for it.
    pub fn hurry(&self) {
        self.0.0.fetch_max(HURRY, Ordering::Relaxed);
    }
}

impl Drop for Underway {
    fn drop(&mut self) {
        self.give_up();
    }
}

/// The cancellation flag of work on another thread: whether its result is still wanted.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicU8>);

impl Stop {
    /// Whether the work has become urgent.
    #[cfg(test)]
    pub fn is_hurried(&self) -> bool {
        self.0.load(Ordering::Relaxed) == HURRY
    }

    /// A [`Progress`] that reports the flag's cancellation, for work that begins now.
    pub fn watch(&self) -> Watch {
        Watch { stop: self.clone(), began: Instant::now() }
    }
}

/// A [`Progress`] that reports a cancellation once the flag demands it.
#[derive(Debug)]
pub struct Watch {
    stop: Stop,
    began: Instant,
}

impl Progress for Watch {
    fn cache(&self) -> Option<Arc<dyn Cache>> {
        unripple_tasks::cache::disk()
    }

    fn cancelled(&self) -> bool {
        match self.stop.0.load(Ordering::Relaxed) {
            GO_ON => false,
            HURRY => self.began.elapsed() > PATIENCE,
            _ => true,
        }
    }
}

/// Returns an error if the work has been cancelled.
///
/// # Errors
/// [`ViewError::Stopped`].
pub fn wanted(progress: &dyn Progress) -> Result<(), ViewError> {
    if progress.cancelled() { Err(ViewError::Stopped) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_given_up_at_once_or_when_it_has_had_its_time() {
        let underway = Underway::default();
        let (fresh, mut old) = (underway.stop().watch(), underway.stop().watch());
        old.began = Instant::now().checked_sub(2 * PATIENCE).unwrap();
        let both = || (fresh.cancelled(), old.cancelled());
        assert_eq!(both(), (false, false));
        underway.hurry();
        assert_eq!(both(), (false, true));
        underway.give_up();
        underway.hurry();
        assert_eq!(both(), (true, true));
    }

    #[test]
    fn work_that_nobody_waits_for_is_given_up() {
        let underway = Underway::default();
        let watch = underway.stop().watch();
        assert!(!watch.cancelled());
        drop(underway);
        assert!(watch.cancelled());
    }
}
