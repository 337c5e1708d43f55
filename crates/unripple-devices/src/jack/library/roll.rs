//! List of the open clients of this program, and whether the library would delete them.
//!
//! Once a server is gone, JACK 2 deletes all clients of the program when another joins
//! (`JackLibGlobals::Init` in its sources); closing one of them later crashes. So, after a server is gone,
//! no client may join before all others have left.

use super::types::RawClient;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Addresses of the clients that are open, so that none is closed that the library has deleted.
static ROLL: Mutex<Vec<usize>> = Mutex::new(Vec::new());

/// Whether a server was gone since a client last joined.
static DOWN: AtomicBool = AtomicBool::new(false);

fn roll() -> MutexGuard<'static, Vec<usize>> {
    ROLL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Records that a server is gone; called from its callback.
pub(super) fn server_gone() {
    DOWN.store(true, Ordering::Release);
}

/// Whether the library would delete clients that are open, if another joined.
pub(super) fn in_danger() -> bool {
    DOWN.load(Ordering::Acquire) && !roll().is_empty()
}

/// Adds a client that has just joined to the list. If a server was gone at that time, it is unknown whether
/// the library deleted the other clients: they are removed from the list, and never closed.
pub(super) fn enter(raw: *mut RawClient) {
    let mut roll = roll();
    if DOWN.swap(false, Ordering::AcqRel) {
        roll.clear();
    }
    roll.push(raw.addr());
}

/// Removes a client that leaves from the list; returns whether it was still there.
pub(super) fn leave(raw: *mut RawClient) -> bool {
    let mut roll = roll();
    let place = roll.iter().position(|open| *open == raw.addr());
    place.map(|place| roll.swap_remove(place)).is_some()
}
