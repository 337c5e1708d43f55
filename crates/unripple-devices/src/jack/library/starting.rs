//! Creation of JACK's threads: the creating thread continues only when the new one runs.
//!
//! JACK 2 gives a thread that it created a second to begin (`JackPosixThread::StartSync` in its sources, a thousand naps of a millisecond).
//! Then it deletes what the thread is to work on, but not the thread: the one that writes messages (`JackMessageBuffer::Create`) and the
//! one that calls in each cycle (`JackClient::Activate`) begin later within memory that is free, and the program crashes. On a machine
//! with more work than processors a thread may well wait that long. So threads are created here, where nobody counts the time that they
//! need until they run. After that a thread has some instructions to go until JACK knows it, for which it is left the processor.
//!
//! Only JACK 2 is given this function: PipeWire's library does not count, and looks after its threads' priorities by functions of its own,
//! which another creator would bypass.

use super::dynamic::Library;
use super::types::Arg;
use std::ffi::{CStr, c_char, c_int};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// Function that a thread runs; the thread may end within it, cancelled by JACK.
type Routine = unsafe extern "C-unwind" fn(Arg) -> Arg;

/// A function that creates threads as `pthread_create` does.
type Create = unsafe extern "C" fn(Arg, Arg, Routine, Arg) -> c_int;

unsafe extern "C" {
    fn pthread_create(thread: Arg, attributes: Arg, routine: Routine, arg: Arg) -> c_int;
}

/// A thread that was created and has not begun: the function that it is to run, and a channel by which it
/// reports that it runs.
struct Start {
    routine: Routine,
    arg: Arg,
    tell: Sender<()>,
}

/// Interval at which the thread that waits for a new one wakes up: so code that judges by it whether the
/// library makes progress, as [`shut`](super::shut) does, sees it run.
const LOOK: Duration = Duration::from_millis(10);

/// Time that the creating thread sleeps after the new one has begun, so that JACK registers the latter
/// before its time-out starts.
const HEADSTART: Duration = Duration::from_millis(2);

/// Beginning of the version strings of JACK 2.
const JACK_2: &str = "1.9.";

/// Makes the library create its threads by [`create`], if it is JACK 2.
pub(super) fn lead(library: &'static Library) {
    // SAFETY: the type is that which jack.h declares for this name.
    let version =
        unsafe { library.get::<unsafe extern "C" fn() -> *const c_char>(b"jack_get_version_string\0") };
    let is_jack_2 = version.is_ok_and(|version| {
        // SAFETY: the text is a constant of the library.
        let text = unsafe {
            let text = version();
            if text.is_null() { c"" } else { CStr::from_ptr(text) }
        };
        text.to_bytes().starts_with(JACK_2.as_bytes())
    });
    if !is_jack_2 {
        return;
    }
    // SAFETY: the type is that which jack.h declares for this name.
    let set = unsafe { library.get::<unsafe extern "C" fn(Create)>(b"jack_set_thread_creator\0") };
    if let Ok(set) = set {
        // SAFETY: the function lives for ever, and creates threads as POSIX has it.
        unsafe { set(create) };
    }
}

/// Creates a thread as `pthread_create` does, and returns once it runs.
unsafe extern "C" fn create(thread: Arg, attributes: Arg, routine: Routine, arg: Arg) -> c_int {
    // SAFETY: the first two are JACK's own, made for this function.
    with(routine, arg, |begin, start| unsafe { pthread_create(thread, attributes, begin, start) })
}

/// Has `spawn` create a thread that runs the routine; returns its result, if that is 0 once the thread runs.
fn with(routine: Routine, arg: Arg, spawn: impl FnOnce(Routine, Arg) -> c_int) -> c_int {
    let (tell, told) = channel();
    let start = Box::into_raw(Box::new(Start { routine, arg, tell }));
    let failed = spawn(begin, start.cast());
    if failed != 0 {
        // SAFETY: no thread was created that would take it.
        drop(unsafe { Box::from_raw(start) });
    } else {
        // Without an answer the thread has ended, and so has begun.
        while told.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {}
        std::thread::sleep(HEADSTART);
    }
    failed
}

/// The beginning of a thread.
unsafe extern "C-unwind" fn begin(start: Arg) -> Arg {
    let (routine, arg) = taken(start.cast());
    // SAFETY: as JACK would have had it called. The thread may end within: nothing is left here that would have to be dropped.
    unsafe { routine(arg) }
}

/// Reads what a thread is to run, and reports that it runs. A thread that just began cannot be cancelled
/// within this function: it has not enabled asynchronous cancellation, and nothing here is a cancellation
/// point.
fn taken(start: *mut Start) -> (Routine, Arg) {
    // SAFETY: made by `with` for this thread alone.
    let start = unsafe { Box::from_raw(start) };
    let _ = start.tell.send(());
    (start.routine, start.arg)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;
    use unripple_core::clock::Instant;

    unsafe extern "C-unwind" fn note(arg: Arg) -> Arg {
        // SAFETY: the tests give a place that outlives the thread.
        unsafe { &*arg.cast::<AtomicBool>() }.store(true, Ordering::Release);
        arg
    }

    #[test]
    fn a_thread_that_begins_late_is_waited_for() {
        static RAN: AtomicBool = AtomicBool::new(false);
        const LATE: Duration = Duration::from_millis(300);
        let began = Instant::now();
        let mut thread = None;
        let failed = with(note, std::ptr::from_ref(&RAN).cast_mut().cast(), |begin, start| {
            let start = start.expose_provenance();
            thread = Some(std::thread::spawn(move || {
                std::thread::sleep(LATE);
                // SAFETY: called once, with what was given for it.
                unsafe { begin(std::ptr::with_exposed_provenance_mut(start)) };
            }));
            0
        });
        assert!(failed == 0 && began.elapsed() >= LATE);
        thread.unwrap().join().unwrap();
        assert!(RAN.load(Ordering::Acquire));
    }

    #[test]
    fn a_thread_that_cannot_be_created_is_not_waited_for() {
        assert_eq!(with(note, std::ptr::null_mut(), |_, _| 11), 11);
    }
}
