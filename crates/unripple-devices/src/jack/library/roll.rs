//! The clients of this program that are open, and whether the library would delete them.
//!
//! Once a server is gone, JACK 2 deletes all clients of the program when another joins (`JackLibGlobals::Init` in its sources); whoever
//! leaves with one of them later crashes. So nobody joins then before all have left.

use super::api::RawClient;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Addresses of the clients that are open, so that none is closed that the library has deleted.
static ROLL: Mutex<Vec<usize>> = Mutex::new(Vec::new());

/// Whether a server was gone since a client last joined.
static DOWN: AtomicBool = AtomicBool::new(false);

fn roll() -> MutexGuard<'static, Vec<usize>> {
    ROLL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps in mind that a server is gone; from its callback.
pub(super) fn server_gone() {
    DOWN.store(true, Ordering::Release);
}

/// Whether the library would delete clients that are open, if another joined.
pub(super) fn in_danger() -> bool {
    DOWN.load(Ordering::Acquire) && !roll().is_empty()
}

/// Enters a client that has just joined. Should a server have gone just then, nobody knows whether the others were deleted: nobody leaves with
/// them any more.
pub(super) fn enter(raw: *mut RawClient) {
    let mut roll = roll();
    if DOWN.swap(false, Ordering::AcqRel) {
        roll.clear();
    }
    roll.push(raw.addr());
}

/// Strikes out a client that leaves; whether it was still there.
pub(super) fn leave(raw: *mut RawClient) -> bool {
    let mut roll = roll();
    let place = roll.iter().position(|open| *open == raw.addr());
    place.map(|place| roll.swap_remove(place)).is_some()
}
