//! How a client leaves its server: on a thread of its own, since a server that stands still answers nobody.

use super::Context;
use super::api::{Api, RawClient};
use crate::DevicesError;
use crate::jack::events::Events;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError, mpsc};
use std::time::{Duration, Instant};

/// How long a client that leaves is waited for, and how long one that joins waits for it: a server at work takes a few cycles.
const PATIENCE: Duration = Duration::from_secs(1);

/// Opening and closing clients is not for two threads at once.
static DOOR: Mutex<()> = Mutex::new(());

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
                    what: "a client of this program is still on its way out of a server that stands still"
                        .into(),
                    fix: "let that server go on, or end it".into(),
                });
            }
        }
    }
}

/// A client that leaves, with all that its callbacks have; it has left once this is dropped.
pub(super) struct Closing {
    pub(super) api: &'static Api,
    pub(super) raw: *mut RawClient,
    pub(super) context: *mut Context,
    /// Whether the server is to go back to its clock.
    pub(super) freewheels: bool,
    pub(super) events: Arc<Events>,
}

// SAFETY: JACK's functions on a client may be called from any thread; the context is the callbacks' until the client is closed, and
// may be freed anywhere.
unsafe impl Send for Closing {}

impl Closing {
    /// Closes, and waits for that for a while; a server that stands still is left to itself, and what its callbacks have is freed once it
    /// goes on.
    pub(super) fn begin(self) {
        let (left, over) = mpsc::channel::<()>();
        let leave = move || {
            drop(self);
            drop(left);
        };
        // Without a thread, the closure is dropped, and closes here.
        let thread = std::thread::Builder::new().name("leave".into()).spawn(leave);
        if thread.is_ok() {
            let _ = over.recv_timeout(PATIENCE);
        }
    }
}

impl Drop for Closing {
    fn drop(&mut self) {
        let _door = DOOR.lock();
        // SAFETY: nobody else has the client, which is open; closing ends the callbacks, and after it nobody has the context.
        unsafe {
            if self.freewheels && !self.events.gone.load(Ordering::Acquire) {
                // A server that cannot go back to its clock is beyond help from here.
                (self.api.set_freewheel)(self.raw, 0);
            }
            (self.api.client_close)(self.raw);
            if !self.context.is_null() {
                drop(Box::from_raw(self.context));
            }
        }
    }
}
