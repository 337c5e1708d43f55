//! A client of a JACK server, independent of this project: it watches ports, or answers packets from its own callback.
#![allow(unsafe_code)]

use libloading::Library;
use std::ffi::{CString, c_char, c_int, c_uint, c_ulong, c_void};
use std::net::UdpSocket;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};

type Raw = *mut c_void;

/// The functions of the JACK library that are used; the library stays loaded.
pub struct Jack {
    open: unsafe extern "C" fn(*const c_char, c_uint, *mut c_uint, ...) -> Raw,
    register: unsafe extern "C" fn(Raw, *const c_char, *const c_char, c_ulong, c_ulong) -> Raw,
    buffer: unsafe extern "C" fn(Raw, u32) -> *mut f32,
    on_process: unsafe extern "C" fn(Raw, unsafe extern "C" fn(u32, Raw) -> c_int, Raw) -> c_int,
    on_xrun: unsafe extern "C" fn(Raw, unsafe extern "C" fn(Raw) -> c_int, Raw) -> c_int,
    activate: unsafe extern "C" fn(Raw) -> c_int,
    connect: unsafe extern "C" fn(Raw, *const c_char, *const c_char) -> c_int,
    times: unsafe extern "C" fn(Raw, *mut u32, *mut u64, *mut u64, *mut f32) -> c_int,
    time: unsafe extern "C" fn() -> u64,
    close: unsafe extern "C" fn(Raw) -> c_int,
}

impl Jack {
    pub fn load() -> Option<&'static Self> {
        // SAFETY: JACK's library has no initialisers that matter; the types are those that jack.h declares; it is never unloaded.
        unsafe {
            let library: &'static Library = Box::leak(Box::new(Library::new("libjack.so.0").ok()?));
            for silent in [b"jack_set_error_function\0".as_slice(), b"jack_set_info_function\0"] {
                type Say = unsafe extern "C" fn(*const c_char);
                let set: libloading::Symbol<unsafe extern "C" fn(Say)> = library.get(silent).ok()?;
                set(ignore);
            }
            let jack = Self {
                open: *library.get(b"jack_client_open\0").ok()?,
                register: *library.get(b"jack_port_register\0").ok()?,
                buffer: *library.get(b"jack_port_get_buffer\0").ok()?,
                on_process: *library.get(b"jack_set_process_callback\0").ok()?,
                on_xrun: *library.get(b"jack_set_xrun_callback\0").ok()?,
                activate: *library.get(b"jack_activate\0").ok()?,
                connect: *library.get(b"jack_connect\0").ok()?,
                times: *library.get(b"jack_get_cycle_times\0").ok()?,
                time: *library.get(b"jack_get_time\0").ok()?,
                close: *library.get(b"jack_client_close\0").ok()?,
            };
            Some(Box::leak(Box::new(jack)))
        }
    }

    /// The server's clock, in µs.
    pub fn now(&self) -> u64 {
        // SAFETY: it may be called at any time.
        unsafe { (self.time)() }
    }
}

/// State that a client shares with its callback.
pub struct Shared {
    jack: &'static Jack,
    raw: Raw,
    rate: f64,
    ins: Vec<Raw>,
    out: Option<(Raw, UdpSocket)>,
    /// Whether the next sample that is not 0 is to be noted, and the time at which it left, in µs; 0 before.
    pub armed: AtomicBool,
    pub found: AtomicU64,
    /// Time at which the last sample that was not 0 left, in µs.
    pub last: AtomicU64,
    /// Number of cycles in a row without a sound, of all cycles, and of late ones.
    pub silent: AtomicU64,
    pub cycles: AtomicU64,
    pub late: AtomicU64,
    /// The callback's thread, as the kernel numbers it.
    pub thread: AtomicU64,
}

/// A client that leaves the server when this is dropped.
pub struct Client {
    pub shared: &'static Shared,
    name: String,
}

/// What the client does in each cycle.
pub enum Role {
    /// Watches so many ports.
    Watch(usize),
    /// Answers each packet with a pulse in the next cycle, and does nothing else.
    Answer(UdpSocket),
}

impl Client {
    /// Joins a server; `None` while it does not answer.
    pub fn open(jack: &'static Jack, server: &str, name: &str, role: Role) -> Option<Self> {
        let (c_name, c_server) = (CString::new(name).ok()?, CString::new(server).ok()?);
        let kind = c"32 bit float mono audio".as_ptr();
        let mut status = 0;
        // SAFETY: strings outlive the calls; 0x05: no server is started, and its name follows. What the callbacks get is leaked.
        unsafe {
            let raw = (jack.open)(c_name.as_ptr(), 0x05, &mut status, c_server.as_ptr());
            if raw.is_null() {
                return None;
            }
            let port = |name: String, flags| {
                let name = CString::new(name).unwrap_or_default();
                (jack.register)(raw, name.as_ptr(), kind, flags, 0)
            };
            let (ins, out) = match role {
                Role::Watch(count) => ((0..count).map(|i| port(format!("in_{i}"), 1)).collect(), None),
                Role::Answer(socket) => (Vec::new(), Some((port("out".into(), 2), socket))),
            };
            let shared: &'static Shared = Box::leak(Box::new(Shared {
                jack,
                raw,
                rate: 48e3,
                ins,
                out,
                armed: AtomicBool::new(false),
                found: AtomicU64::new(0),
                last: AtomicU64::new(0),
                silent: AtomicU64::new(0),
                cycles: AtomicU64::new(0),
                late: AtomicU64::new(0),
                thread: AtomicU64::new(0),
            }));
            let arg = (shared as *const Shared).cast_mut().cast::<c_void>();
            let set = [(jack.on_process)(raw, on_process, arg), (jack.on_xrun)(raw, on_xrun, arg)];
            let active = set == [0, 0] && (jack.activate)(raw) == 0;
            active.then(|| Self { shared, name: name.to_owned() })
        }
    }

    /// Connects a port of another client to a port of this one.
    pub fn hear(&self, from: &str, input: usize) -> bool {
        let to = CString::new(format!("{}:in_{input}", self.name)).unwrap_or_default();
        let from = CString::new(from).unwrap_or_default();
        // SAFETY: the client is open, strings outlive the call. 17: it is there already.
        matches!(unsafe { (self.shared.jack.connect)(self.shared.raw, from.as_ptr(), to.as_ptr()) }, 0 | 17)
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        // SAFETY: once for each client; what its callbacks had is leaked and so still there.
        unsafe { (self.shared.jack.close)(self.shared.raw) };
    }
}

// SAFETY: JACK's functions may be called from any thread; the callbacks share atomics and what is only read.
unsafe impl Sync for Shared {}
// SAFETY: as above.
unsafe impl Send for Shared {}

unsafe extern "C" fn ignore(_: *const c_char) {}

unsafe extern "C" fn on_xrun(arg: Raw) -> c_int {
    // SAFETY: leaked, and only atomics are changed.
    unsafe { &*arg.cast::<Shared>() }.late.fetch_add(1, Relaxed);
    0
}

unsafe extern "C" fn on_process(frames: u32, arg: Raw) -> c_int {
    // SAFETY: leaked; within the callback a port's buffer holds so many floats.
    unsafe {
        let shared = &*arg.cast::<Shared>();
        if shared.cycles.fetch_add(1, Relaxed) == 0 {
            shared.thread.store(this_thread(), Relaxed);
        }
        if let Some((port, socket)) = &shared.out {
            let buffer = std::slice::from_raw_parts_mut((shared.jack.buffer)(*port, frames), frames as usize);
            buffer.fill(0.0);
            let mut packet = [0; 64];
            while socket.recv(&mut packet).is_ok() {
                buffer[0] = 0.5;
            }
            return 0;
        }
        let sounds = |port: &Raw| {
            let heard = std::slice::from_raw_parts((shared.jack.buffer)(*port, frames), frames as usize);
            let first = heard.iter().position(|x| *x != 0.0)?;
            Some((first, heard.iter().rposition(|x| *x != 0.0)?))
        };
        let sounding = shared.ins.iter().filter_map(sounds).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let Some((first, last)) = sounding else {
            shared.silent.fetch_add(1, Relaxed);
            return 0;
        };
        shared.silent.store(0, Relaxed);
        let (mut frame, mut began, mut next, mut period) = (0, 0, 0, 0.0);
        (shared.jack.times)(shared.raw, &mut frame, &mut began, &mut next, &mut period);
        let at = |sample: usize| began + (1e6 * sample as f64 / shared.rate) as u64;
        shared.last.store(at(last), Relaxed);
        if shared.armed.swap(false, Relaxed) {
            shared.found.store(at(first), Relaxed);
        }
        0
    }
}

/// The kernel's number of the calling thread: its folder is called `PID/task/TID`.
fn this_thread() -> u64 {
    let link = std::fs::read_link("/proc/thread-self").unwrap_or_default();
    link.file_name().and_then(|name| name.to_str()?.parse().ok()).unwrap_or(0)
}
