//! Progress of long computations: observers are notified of what is being computed, and how much of it is
//! done.

use crate::scope;
use std::cell::RefCell;
use std::sync::{Arc, Mutex, PoisonError};

/// Receives progress notifications from a long computation. Its methods are called from any thread of the
/// computation, rarely enough that a lock in them costs nothing.
pub trait Observer: Send + Sync {
    /// Called when a part of the computation begins; `what` describes that part in words.
    fn part(&self, what: &str);

    /// Called with the share (0 to 1) of the current part that is done.
    fn done(&self, share: f64);
}

thread_local! {
    /// The observer that computations begun on this thread notify; `None` if there is none.
    static HERE: RefCell<Option<Arc<dyn Observer>>> = const { RefCell::new(None) };
}

/// The [`Observer`] of a computation, if there is one: a handle through which the computation reports its
/// progress. A computation takes the handle that was set for the thread on which it begins, and passes it
/// to its other threads; functions in between need no parameter for it. It changes no result.
///
/// ```
/// use std::sync::{Arc, Mutex};
/// use unripple_core::{Observed, Observer};
///
/// #[derive(Default)]
/// struct Log(Mutex<Vec<String>>);
///
/// impl Observer for Log {
///     fn part(&self, what: &str) {
///         self.0.lock().unwrap().push(what.into());
///     }
///
///     fn done(&self, share: f64) {
///         self.0.lock().unwrap().push(format!("{:.0} %", 100.0 * share));
///     }
/// }
///
/// fn long_sum(count: usize) -> usize {
///     let observed = Observed::here();
///     observed.part(|| format!("{count} numbers"));
///     let steps = observed.steps(count);
///     (0..count).inspect(|_| steps.take(1.0)).sum()
/// }
///
/// let log = Arc::new(Log::default());
/// let sum = Observed::by(Some(log.clone())).during(|| long_sum(4));
/// assert_eq!((sum, long_sum(4)), (6, 6));
/// assert_eq!(*log.0.lock().unwrap(), ["4 numbers", "25 %", "50 %", "75 %", "100 %"]);
/// ```
#[derive(Clone, Default)]
pub struct Observed(Option<Arc<dyn Observer>>);

impl std::fmt::Debug for Observed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Observed").field("observer", &self.0.is_some()).finish()
    }
}

impl Observed {
    /// A handle that notifies `observer`; with `None`, progress is not reported.
    pub fn by(observer: Option<Arc<dyn Observer>>) -> Self {
        Self(observer)
    }

    /// The handle that is set for the current thread (see [`Observed::during`]); one without an observer if
    /// none is set.
    pub fn here() -> Self {
        Self(HERE.with_borrow(Clone::clone))
    }

    /// Runs `work` on the current thread with this handle set for that thread, and restores the previous
    /// handle afterwards.
    pub fn during<T>(&self, work: impl FnOnce() -> T) -> T {
        scope::during(&HERE, self.0.clone(), work)
    }

    /// A handle to the same observer that prefixes the name of each part with `whole` and a colon.
    #[must_use]
    pub fn within(&self, whole: impl Into<String>) -> Self {
        let within = |to: &Arc<dyn Observer>| -> Arc<dyn Observer> {
            Arc::new(Within { whole: whole.into(), to: to.clone() })
        };
        Self(self.0.as_ref().map(within))
    }

    /// Notifies the observer that a part of the computation begins; `what`, which describes the part, is
    /// called only if there is an observer.
    pub fn part(&self, what: impl FnOnce() -> String) {
        if let Some(observer) = &self.0 {
            observer.part(&what());
        }
    }

    /// Notifies the observer of the share (0 to 1) of the current part that is done.
    pub fn done(&self, share: f64) {
        if let Some(observer) = &self.0 {
            observer.done(share.clamp(0.0, 1.0));
        }
    }

    /// A counter for a part that consists of `total` steps; the steps may run on several threads.
    pub fn steps(&self, total: usize) -> Steps {
        Steps { observed: self.clone(), total: total.max(1) as f64, taken: Mutex::new(0.0) }
    }
}

/// An observer that prefixes the names of parts with `whole` before it passes them on.
struct Within {
    whole: String,
    to: Arc<dyn Observer>,
}

impl Observer for Within {
    fn part(&self, what: &str) {
        self.to.part(&format!("{}: {what}", self.whole));
    }

    fn done(&self, share: f64) {
        self.to.done(share);
    }
}

/// Counts the finished steps of a part of a computation, on all threads, and notifies the observer.
#[derive(Debug)]
pub struct Steps {
    observed: Observed,
    total: f64,
    taken: Mutex<f64>,
}

impl Steps {
    /// Counts one step as done, or only a `share` (0 to 1) of it, and notifies the observer of the share of
    /// all steps that is done.
    pub fn take(&self, share: f64) {
        // Locked during the notification, so that shares of several threads are reported in order.
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        *taken += share.clamp(0.0, 1.0);
        self.observed.done(*taken / self.total);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Default)]
    struct Log(Mutex<Vec<String>>);

    impl Observer for Log {
        fn part(&self, what: &str) {
            self.0.lock().unwrap().push(what.into());
        }

        fn done(&self, share: f64) {
            self.0.lock().unwrap().push(format!("{share:.2}"));
        }
    }

    #[test]
    fn parts_are_told_within_their_whole_and_no_longer_than_asked() {
        let log = Arc::new(Log::default());
        let observed = Observed::by(Some(log.clone()));
        observed.during(|| {
            Observed::here().part(|| "first".into());
            Observed::here().within("whole").during(|| Observed::here().part(|| "second".into()));
            Observed::here().part(|| "third".into());
        });
        Observed::here().part(|| unreachable!("nobody observes"));
        let panics = || observed.during::<()>(|| panic!("of a test"));
        let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(panics));
        assert!(panicked.is_err());
        Observed::here().part(|| unreachable!("nobody observes after a panic"));
        assert_eq!(*log.0.lock().unwrap(), ["first", "whole: second", "third"]);
    }

    #[test]
    fn steps_of_all_threads_are_counted() {
        let log = Arc::new(Log::default());
        let steps = Observed::by(Some(log.clone())).steps(4);
        std::thread::scope(|scope| {
            (0..4).for_each(|_| {
                scope.spawn(|| (0..2).for_each(|_| steps.take(0.5)));
            });
        });
        let told = log.0.lock().unwrap();
        assert_eq!(told.len(), 8);
        assert!(told.contains(&"1.00".to_owned()) && told.contains(&"0.50".to_owned()), "{told:?}");
    }
}
