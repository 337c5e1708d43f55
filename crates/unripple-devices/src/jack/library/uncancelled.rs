//! Protection of this crate's code on JACK's threads against cancellation of the thread.
//!
//! A client that leaves ends its thread by `pthread_cancel`, at any instruction. Within our code that would leave memory half-written, and
//! where such an end, which unwinds the thread by force, meets a [`catch_unwind`](std::panic::catch_unwind), the C library ends the whole
//! program. Functions on the way are `C-unwind`, and have nothing to drop: through these a thread may end.

#[cfg(unix)]
use std::ffi::c_int;

/// The state in which a thread puts off its cancellation: of Linux's C libraries, and of the others' (macOS).
#[cfg(unix)]
const DISABLE: c_int = if cfg!(target_os = "linux") { 1 } else { 0 };

#[cfg(unix)]
unsafe extern "C-unwind" {
    fn pthread_setcancelstate(state: c_int, before: *mut c_int) -> c_int;
}

/// Runs `work` with cancellation of the thread disabled; a cancellation that is requested meanwhile takes
/// effect afterwards.
#[cfg(unix)]
pub(super) fn uncancelled<T: Copy>(work: impl FnOnce() -> T) -> T {
    let mut before = 0;
    // SAFETY: the state is the thread's own; the place written to lives until the call returns.
    unsafe { pthread_setcancelstate(DISABLE, &mut before) };
    let done = work();
    // SAFETY: as above. The thread may end here: nothing that would have to be dropped is left in this frame or its callers'.
    unsafe { pthread_setcancelstate(before, &mut before) };
    done
}

/// Elsewhere threads are not cancelled.
#[cfg(not(unix))]
pub(super) fn uncancelled<T: Copy>(work: impl FnOnce() -> T) -> T {
    work()
}
