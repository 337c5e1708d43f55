//! The functions of the C library of JACK, as `jack/jack.h` declares them, found at run time; the library stays loaded for ever.

use super::dynamic::{Error, Library};
#[cfg(unix)]
use super::starting;
use super::types::{Arg, LatencyRange, RawClient, RawPort};
use crate::DevicesError;
use std::ffi::{c_char, c_int, c_uint, c_ulong, c_void};
use std::sync::OnceLock;

/// The functions used, by their C names without `jack_`.
macro_rules! functions {
    ($($name:ident: fn($($arg:ty),*) $(-> $result:ty)?;)*) => {
        pub(super) struct Api {
            // The only variadic one: the server's name follows the status.
            pub(super) client_open: unsafe extern "C" fn(*const c_char, c_uint, *mut c_uint, ...) -> *mut RawClient,
            $(pub(super) $name: unsafe extern "C" fn($($arg),*) $(-> $result)?,)*
        }

        impl Api {
            unsafe fn find(library: &'static Library) -> Result<Self, Error> {
                // SAFETY: the types are those that jack.h declares for these names.
                unsafe {
                    Ok(Self {
                        client_open: *library.get(b"jack_client_open\0")?,
                        $($name: *library.get(concat!("jack_", stringify!($name), "\0").as_bytes())?,)*
                    })
                }
            }
        }
    };
}

functions! {
    client_close: fn(*mut RawClient) -> c_int;
    activate: fn(*mut RawClient) -> c_int;
    get_sample_rate: fn(*mut RawClient) -> u32;
    get_buffer_size: fn(*mut RawClient) -> u32;
    get_client_name: fn(*mut RawClient) -> *const c_char;
    port_register: fn(*mut RawClient, *const c_char, *const c_char, c_ulong, c_ulong) -> *mut RawPort;
    port_get_buffer: fn(*mut RawPort, u32) -> *mut c_void;
    set_process_callback: fn(*mut RawClient, unsafe extern "C-unwind" fn(u32, Arg) -> c_int, Arg) -> c_int;
    set_xrun_callback: fn(*mut RawClient, unsafe extern "C" fn(Arg) -> c_int, Arg) -> c_int;
    set_freewheel_callback: fn(*mut RawClient, unsafe extern "C" fn(c_int, Arg), Arg) -> c_int;
    on_shutdown: fn(*mut RawClient, unsafe extern "C-unwind" fn(Arg), Arg);
    set_freewheel: fn(*mut RawClient, c_int) -> c_int;
    is_realtime: fn(*mut RawClient) -> c_int;
    client_real_time_priority: fn(*mut RawClient) -> c_int;
    get_time: fn() -> u64;
    last_frame_time: fn(*const RawClient) -> u32;
    get_cycle_times: fn(*const RawClient, *mut u32, *mut u64, *mut u64, *mut f32) -> c_int;
    port_get_latency_range: fn(*mut RawPort, c_uint, *mut LatencyRange);
    connect: fn(*mut RawClient, *const c_char, *const c_char) -> c_int;
    get_ports: fn(*mut RawClient, *const c_char, *const c_char, c_ulong) -> *mut *const c_char;
    free: fn(*mut c_void);
    set_error_function: fn(unsafe extern "C" fn(*const c_char));
    set_info_function: fn(unsafe extern "C" fn(*const c_char));
}

/// The functions of the library, which is searched on the first call.
pub(super) fn api() -> Result<&'static Api, DevicesError> {
    static API: OnceLock<Result<Api, String>> = OnceLock::new();
    let names: &[&str] = if cfg!(target_os = "macos") {
        &["libjack.0.dylib", "/usr/local/lib/libjack.dylib", "/opt/homebrew/lib/libjack.dylib"]
    } else if cfg!(windows) {
        &["libjack64.dll", "libjack.dll"]
    } else {
        &["libjack.so.0", "libjack.so"]
    };
    let found = API.get_or_init(|| {
        let mut why = String::new();
        for name in names {
            // SAFETY: JACK's library has no initialisers that matter, and is never unloaded.
            match unsafe { Library::new(name) } {
                Ok(library) => {
                    let library: &'static Library = Box::leak(Box::new(library));
                    // SAFETY: see the function.
                    let api = unsafe { Api::find(library) }.map_err(|error| error.to_string())?;
                    // SAFETY: the functions live for ever and ignore what they get.
                    unsafe {
                        (api.set_error_function)(ignore);
                        (api.set_info_function)(ignore);
                    }
                    #[cfg(unix)]
                    starting::lead(library);
                    return Ok(api);
                }
                Err(error) => why = error.to_string(),
            }
        }
        Err(why)
    });
    found.as_ref().map_err(|why| DevicesError::Jack {
        what: format!("its library is not there ({why})"),
        fix: "install it (Debian: apt install jackd2, or pipewire-jack)".into(),
    })
}

unsafe extern "C" fn ignore(_: *const c_char) {}
