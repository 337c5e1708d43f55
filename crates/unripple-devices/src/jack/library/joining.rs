//! How a client joins a server: on a thread of its own, since a library that waits for a lock, or for a server that stands still, never
//! returns.

use super::api::{Api, RawClient};
use super::door::{DOOR, door};
use crate::DevicesError;
use std::sync::mpsc;
use std::time::Duration;

/// How long the library is waited for to join: a server at work answers within some cycles, one on a loaded machine within a second.
const JOINING: Duration = Duration::from_secs(5);

/// A client just opened, until somebody takes it; whoever waited for it has gone otherwise, and it is closed again.
struct Opened(&'static Api, *mut RawClient);

// SAFETY: JACK's functions on a client may be called from any thread.
unsafe impl Send for Opened {}

impl Opened {
    fn take(mut self) -> *mut RawClient {
        std::mem::replace(&mut self.1, std::ptr::null_mut())
    }
}

impl Drop for Opened {
    fn drop(&mut self) {
        if !self.1.is_null() {
            // SAFETY: nobody else has the client, which is open.
            unsafe { (self.0.client_close)(self.1) };
        }
    }
}

/// Joins a server by a call of the library, which gives a null pointer where none answers.
///
/// # Errors
/// [`DevicesError::Jack`] if the call does not return, or while another client joins or leaves.
pub(super) fn join(
    api: &'static Api,
    open: impl FnOnce() -> *mut RawClient + Send + 'static,
) -> Result<*mut RawClient, DevicesError> {
    drop(door()?);
    let (tell, told) = mpsc::channel();
    let call = move || {
        let _door = DOOR.lock();
        // Nobody there any more drops it, and so closes it.
        let _ = tell.send(Opened(api, open()));
    };
    let spawned = std::thread::Builder::new().name("join".into()).spawn(call);
    spawned.map_err(|error| DevicesError::Jack {
        what: format!("no thread to join a server with ({error})"),
        fix: "end other programs".into(),
    })?;
    told.recv_timeout(JOINING).map(Opened::take).map_err(|_| DevicesError::Jack {
        what: format!("no answer within {} s", JOINING.as_secs()),
        fix: format!(
            "let a server that stands still go on, or end it; if there is none, a program was killed while it held JACK's lock: end all \
             JACK programs and remove {}",
            database()
        ),
    })
}

/// Where JACK 2 keeps the database that its programs share.
fn database() -> String {
    #[cfg(target_os = "linux")]
    if let Ok(own) = std::fs::metadata("/proc/self") {
        return format!("/dev/shm/jack_db-{}", std::os::unix::fs::MetadataExt::uid(&own));
    }
    "its folder `jack_db` among the temporary files".into()
}
