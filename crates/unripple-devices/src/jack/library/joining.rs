//! Joining of a client to a server, on a separate thread, since a library that waits for a lock, or for a
//! stopped server, never returns.

use super::api::Api;
use super::door::{PATIENCE, Passage, door};
use super::roll;
use super::types::RawClient;
use crate::DevicesError;
use std::sync::mpsc;
use std::time::Duration;
use unripple_core::clock::Instant;

/// Longest wait for the library to join: a running server answers within some cycles, one on a loaded
/// machine within a second.
const JOINING: Duration = Duration::from_secs(5);

/// A client that was just opened, until it is taken; if the thread that waited for it has gone, the client is closed again.
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
        if !self.1.is_null() && roll::leave(self.1) {
            // SAFETY: nobody else has the client, which is open.
            unsafe { (self.0.client_close)(self.1) };
        }
    }
}

/// Joins a server by a call of the library, which returns a null pointer if no server answers.
///
/// # Errors
/// [`DevicesError::Jack`] if the call does not return, while another client joins or leaves, or while one has not left a server that is
/// gone.
pub(super) fn join(
    api: &'static Api,
    open: impl FnOnce() -> *mut RawClient + Send + 'static,
) -> Result<*mut RawClient, DevicesError> {
    let start = Instant::now();
    while roll::in_danger() && start.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(1));
    }
    door()?;
    let (tell, told) = mpsc::channel();
    let call = move || {
        let _passage = Passage::wait();
        let opened = (!roll::in_danger()).then(|| {
            let raw = open();
            if !raw.is_null() {
                roll::enter(raw);
            }
            Opened(api, raw)
        });
        // If nobody waits any more, this drops the client, and so closes it.
        let _ = tell.send(opened);
    };
    let spawned = std::thread::Builder::new().name("join".into()).spawn(call);
    spawned.map_err(|error| DevicesError::Jack {
        what: format!("no thread to join a server with ({error})"),
        fix: "end other programs".into(),
    })?;
    match told.recv_timeout(JOINING) {
        Ok(Some(opened)) => Ok(opened.take()),
        Ok(None) => Err(DevicesError::Jack {
            what: "a client of this program has not been closed since its server ended".into(),
            fix: "close it first".into(),
        }),
        Err(_) => Err(DevicesError::Jack {
            what: format!("no answer within {} s", JOINING.as_secs()),
            fix: format!(
                "if the server does not respond, let it continue or end it; otherwise a program was killed while it held JACK's lock: end \
                 all JACK programs and remove {}",
                database()
            ),
        }),
    }
}

/// Path of the database that JACK 2 programs share.
fn database() -> String {
    #[cfg(target_os = "linux")]
    if let Ok(own) = std::fs::metadata("/proc/self") {
        return format!("/dev/shm/jack_db-{}", std::os::unix::fs::MetadataExt::uid(&own));
    }
    "its folder `jack_db` among the temporary files".into()
}
