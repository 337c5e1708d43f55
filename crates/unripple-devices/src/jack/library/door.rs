//! One client of this program at a time joins or leaves: the library keeps some of its state per program.

use super::caller::Caller;
use crate::DevicesError;
use std::ffi::c_int;
use std::sync::{Mutex, MutexGuard, Once, PoisonError, TryLockError};
use std::time::{Duration, Instant};

/// How long a client that leaves is waited for, and how long one that joins waits for it: a server at work takes a few cycles.
pub(super) const PATIENCE: Duration = Duration::from_secs(1);

/// How long a program that ends waits for a call of the library that makes progress: other programs may leave it a twentieth of the time
/// that it needs.
const PROGRESS: Duration = Duration::from_secs(10);

/// Opening and closing clients is not for two threads at once.
static DOOR: Mutex<()> = Mutex::new(());

/// The thread that is calling the library; `None` where the system does not tell.
static CALLER: Mutex<Option<Caller>> = Mutex::new(None);

/// Permission to call the library, until it is dropped.
pub(super) struct Passage {
    _door: MutexGuard<'static, ()>,
}

impl Passage {
    /// Waits until no other thread is in the library.
    pub(super) fn wait() -> Self {
        static WATCHED: Once = Once::new();
        WATCHED.call_once(|| {
            // SAFETY: a C function that is called once, from a program that ends; it neither unwinds nor uses what may be gone by then. If
            // it cannot be registered, a program ends as one that never heard of it.
            unsafe { atexit(shut_at_exit) };
        });
        let door = DOOR.lock().unwrap_or_else(PoisonError::into_inner);
        *caller() = Caller::this_thread();
        Self { _door: door }
    }
}

impl Drop for Passage {
    fn drop(&mut self) {
        *caller() = None;
    }
}

fn caller() -> MutexGuard<'static, Option<Caller>> {
    CALLER.lock().unwrap_or_else(PoisonError::into_inner)
}

unsafe extern "C" {
    /// Has a function called when the program ends by itself.
    fn atexit(call: extern "C" fn()) -> c_int;
}

extern "C" fn shut_at_exit() {
    shut();
}

/// Waits until no client joins or leaves.
///
/// # Errors
/// [`DevicesError::Jack`] while a client cannot leave its server: until it has, the library lets no client join any server.
pub(super) fn door() -> Result<(), DevicesError> {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        match DOOR.try_lock() {
            Err(TryLockError::WouldBlock) => std::thread::sleep(Duration::from_millis(1)),
            _ => return Ok(()),
        }
    }
    Err(DevicesError::Jack {
        what: "a client of this program is still joining or leaving a server that does not respond".into(),
        fix: "let that server continue, or end it".into(),
    })
}

/// Lets no client join or leave any more, for a program that is about to end. Waits before until none does: for a call that makes progress
/// ten seconds at most, for one that sleeps a second.
///
/// The library locks a database of all JACK programs of a user within these calls. The lock of a program that ends within one stays, and
/// every JACK program of that user, started then, waits for it for ever. A call that waits for a server that stands still sleeps, and
/// holds no lock.
pub(in crate::jack) fn shut() {
    let start = Instant::now();
    let (mut before, mut progress) = (None, start);
    while start.elapsed() < PROGRESS && progress.elapsed() < PATIENCE {
        match DOOR.try_lock() {
            Ok(door) => return std::mem::forget(door),
            Err(TryLockError::Poisoned(door)) => return std::mem::forget(door.into_inner()),
            Err(TryLockError::WouldBlock) => {}
        }
        let now = caller().as_ref().and_then(Caller::activity);
        if now.as_ref().is_some_and(|now| now.waits_for_a_processor) || now != before {
            (before, progress) = (now, Instant::now());
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}
