//! Threads where there are any. WebAssembly in a page has none: what would run beside its caller runs in its place.

use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

/// Whether threads can be started.
pub const AVAILABLE: bool = !cfg!(target_family = "wasm");

/// A thread that was started, or work that was done in place of one.
#[derive(Debug)]
pub struct Started(Option<std::thread::JoinHandle<()>>);

impl Started {
    /// Waits until the work has ended.
    ///
    /// # Errors
    /// What the work panicked with.
    pub fn join(self) -> std::thread::Result<()> {
        self.0.map_or(Ok(()), std::thread::JoinHandle::join)
    }
}

/// Does `work` on a new thread of this name; where there are no threads, before it returns. Such work must not wait for its caller.
///
/// ```
/// use std::sync::mpsc::channel;
/// use std::time::Duration;
/// use unripple_core::threads::{receive, start};
///
/// let (tell, told) = channel();
/// let started = start("sum", move || tell.send(2 + 2).unwrap())?;
/// assert_eq!(receive(&told, Duration::from_secs(60)), Ok(4));
/// started.join().unwrap();
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// That of the operating system if it has no thread to spare.
pub fn start(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<Started> {
    if AVAILABLE {
        return std::thread::Builder::new().name(name.into()).spawn(work).map(|thread| Started(Some(thread)));
    }
    work();
    Ok(Started(None))
}

/// Waits at most some time for a value from work that was started. Where there are no threads that work is done: nothing is waited for.
///
/// # Errors
/// [`RecvTimeoutError`] if there is no value in that time, or there will never be one.
pub fn receive<T>(from: &Receiver<T>, at_most: Duration) -> Result<T, RecvTimeoutError> {
    if AVAILABLE {
        return from.recv_timeout(at_most);
    }
    from.try_recv().map_err(|_| RecvTimeoutError::Disconnected)
}
