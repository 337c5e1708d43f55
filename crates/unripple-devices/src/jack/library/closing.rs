//! Leaving of a client from its server, on a separate thread, since a server that has stopped does not
//! answer.

use super::Context;
use super::api::Api;
use super::door::{PATIENCE, Passage};
use super::roll;
use super::types::RawClient;
use crate::jack::events::Events;
use std::sync::atomic::Ordering;
use std::sync::{Arc, mpsc};

/// A client that leaves its server, with all data of its callbacks; it has left once this is dropped.
pub(super) struct Closing {
    pub(super) api: &'static Api,
    pub(super) raw: *mut RawClient,
    pub(super) context: *mut Context,
    /// Whether the server is to return from freewheeling to its clock.
    pub(super) freewheels: bool,
    pub(super) events: Arc<Events>,
}

// SAFETY: JACK's functions on a client may be called from any thread; the context is the callbacks' until the client is closed, and
// may be freed anywhere.
unsafe impl Send for Closing {}

impl Closing {
    /// Closes the client, and waits for that for a limited time. If the server has stopped, this returns
    /// without waiting any longer, and the data of the callbacks is freed once the server continues.
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
        let _passage = Passage::wait();
        if !roll::leave(self.raw) {
            // The library may have deleted it, or may not; its callbacks keep what they have.
            std::mem::forget(self.events.clone());
            return;
        }
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
