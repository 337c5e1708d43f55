//! Waking of the program by the threads of a card for which it waits.

use std::sync::atomic::{Ordering, fence};
use std::sync::{PoisonError, RwLock};
use std::thread::{Thread, ThreadId};

/// Wakes one registered thread. Waking neither blocks nor allocates.
#[derive(Debug, Default)]
pub(super) struct Bell(RwLock<Option<Thread>>);

impl Bell {
    /// Registers the calling thread as the one to wake. After this call, and before it parks, the thread has
    /// to check again whether it still needs to wait.
    pub(super) fn listen(&self) {
        *self.0.write().unwrap_or_else(PoisonError::into_inner) = Some(std::thread::current());
        // Either the waking thread sees the registered one, or the latter sees the data of the former.
        fence(Ordering::SeqCst);
    }

    /// Whether `thread` is the registered thread.
    pub(super) fn wakes(&self, thread: ThreadId) -> bool {
        let listener = self.0.read().unwrap_or_else(PoisonError::into_inner);
        listener.as_ref().is_some_and(|listener| listener.id() == thread)
    }

    /// Wakes the registered thread. A thread that is just registering need not be woken: it checks by
    /// itself.
    pub(super) fn ring(&self) {
        fence(Ordering::SeqCst);
        if let Ok(listener) = self.0.try_read()
            && let Some(thread) = listener.as_ref()
        {
            thread.unpark();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::AtomicU32;

    /// Every ring is seen: a listener that parks without a limit never sleeps on what was brought.
    #[test]
    fn no_ring_is_missed() {
        let (bell, brought, taken) =
            (Arc::new(Bell::default()), Arc::new(AtomicU32::new(0)), AtomicU32::new(0));
        let times = 20_000;
        std::thread::scope(|scope| {
            let listener = scope.spawn(|| {
                bell.listen();
                while taken.load(Ordering::Relaxed) < times {
                    let seen = brought.load(Ordering::Acquire);
                    if seen == taken.load(Ordering::Relaxed) {
                        std::thread::park();
                    }
                    taken.store(seen, Ordering::Release);
                }
            });
            for i in 1..=times {
                brought.store(i, Ordering::Release);
                bell.ring();
                if i % 7 == 0 {
                    std::thread::yield_now();
                }
            }
            // The listener may have begun after the last ring: then it looked by itself.
            listener.join().unwrap();
        });
        assert!(!bell.wakes(std::thread::current().id()));
        bell.listen();
        assert!(bell.wakes(std::thread::current().id()));
    }
}
