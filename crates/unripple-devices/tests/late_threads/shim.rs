//! A library to be loaded before all others: threads that a thread called `join` creates begin more than a second late.
#![crate_type = "cdylib"]

use std::ffi::{CStr, c_char, c_int, c_void};
use std::time::Duration;

/// JACK gives a thread a thousand naps of a millisecond, which take some more.
const LATE: Duration = Duration::from_millis(1400);

type Routine = unsafe extern "C-unwind" fn(*mut c_void) -> *mut c_void;
type Create = unsafe extern "C" fn(*mut c_void, *mut c_void, Routine, *mut c_void) -> c_int;

unsafe extern "C" {
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
    fn prctl(option: c_int, ...) -> c_int;
}

/// `PR_GET_NAME`, and `RTLD_NEXT`.
const GET_NAME: c_int = 16;
const NEXT: usize = usize::MAX;

unsafe extern "C-unwind" fn late(start: *mut c_void) -> *mut c_void {
    let (routine, arg) = *unsafe { Box::from_raw(start.cast::<(Routine, *mut c_void)>()) };
    std::thread::sleep(LATE);
    unsafe { routine(arg) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn pthread_create(
    thread: *mut c_void,
    attributes: *mut c_void,
    routine: Routine,
    arg: *mut c_void,
) -> c_int {
    let next = unsafe { dlsym(NEXT as *mut c_void, c"pthread_create".as_ptr()) };
    let next: Create = unsafe { std::mem::transmute(next) };
    let mut name = [0u8; 16];
    unsafe { prctl(GET_NAME, name.as_mut_ptr()) };
    if CStr::from_bytes_until_nul(&name).is_ok_and(|name| name == c"join") {
        let start = Box::into_raw(Box::new((routine, arg)));
        return unsafe { next(thread, attributes, late, start.cast()) };
    }
    unsafe { next(thread, attributes, routine, arg) }
}
