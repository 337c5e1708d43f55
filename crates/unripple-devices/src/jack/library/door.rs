//! One client of this program at a time joins or leaves: the library keeps some of its state per program.

use crate::DevicesError;
use std::sync::{Mutex, MutexGuard, TryLockError};
use std::time::{Duration, Instant};

/// How long a client that leaves is waited for, and how long one that joins waits for it: a server at work takes a few cycles.
pub(super) const PATIENCE: Duration = Duration::from_secs(1);

/// Opening and closing clients is not for two threads at once.
pub(super) static DOOR: Mutex<()> = Mutex::new(());

/// Waits until no client joins or leaves.
///
/// # Errors
/// [`DevicesError::Jack`] while one cannot leave its server: the library would let nobody join any server before.
pub(super) fn door() -> Result<MutexGuard<'static, ()>, DevicesError> {
    let start = Instant::now();
    loop {
        match DOOR.try_lock() {
            Ok(door) => return Ok(door),
            Err(TryLockError::Poisoned(door)) => return Ok(door.into_inner()),
            Err(TryLockError::WouldBlock) if start.elapsed() < PATIENCE => {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err(TryLockError::WouldBlock) => {
                return Err(DevicesError::Jack {
                    what: "a client of this program is still on its way into or out of a server that stands still"
                        .into(),
                    fix: "let that server go on, or end it".into(),
                });
            }
        }
    }
}

/// Waits until no client joins or leaves, a second at most, and lets none do so any more: for a program that is about to be ended.
///
/// The library locks a database of all JACK programs of a user meanwhile. The lock of a program that ends within it stays, and every
/// JACK program of that user, started then, waits for it for ever.
pub(in crate::jack) fn shut() {
    if let Ok(door) = door() {
        std::mem::forget(door);
    }
}
