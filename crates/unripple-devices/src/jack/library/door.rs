//! Lock that lets only one client of this program at a time join or leave a server: the library has state
//! per program.

use super::caller::Caller;
use crate::DevicesError;
use std::ffi::c_int;
use std::sync::{Mutex, MutexGuard, Once, PoisonError, TryLockError};
use std::time::Duration;
use unripple_core::clock::Instant;

/// How long this program waits for a client that leaves, and a joining client for the lock: a running server
/// takes a few cycles.
pub(super) const PATIENCE: Duration = Duration::from_secs(1);

/// How long a program that ends waits for a library call that makes progress: other programs may leave it
/// only a twentieth of the processor time.
const PROGRESS: Duration = Duration::from_secs(10);

/// Lock for opening and closing clients, which two threads must not do at once.
static DOOR: Mutex<()> = Mutex::new(());

/// The thread that is calling the library; `None` if the system does not report its activity.
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
    /// Registers a function to be called when the program ends by itself.
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

/// Prevents all later joining and leaving of clients, for a program that is about to end. Waits first until
/// no client is joining or leaving: ten seconds at most for a call that makes progress, one second for a
/// call that sleeps.
///
/// The library locks a database of all JACK programs of a user within these calls. If a program ends within
/// one, its lock remains, and every JACK program of that user that is started later waits for it for ever. A
/// call that waits for a stopped server sleeps, and holds no lock.
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
