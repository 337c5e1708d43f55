//! The C library of JACK, opened at run time: no build depends on it, and where it is missing that is an error like any
//! other. The one place of this crate with `unsafe`: calls across the C interface, as `jack/jack.h` declares it.
//!
//! What makes them sound: the library stays loaded for ever; a client's raw pointer lives from [`Client::open`] until
//! [`Closing`] closes it, before the context of the callbacks is freed; the process callback alone touches the context's
//! process part, on one thread at a time, as JACK promises, and that thread does not end within it; strings that JACK gives are copied at
//! once; panics do not cross the interface.
#![allow(unsafe_code)]

mod api;
mod caller;
mod closing;
mod door;
mod dynamic;
mod joining;
mod roll;
#[cfg(unix)]
mod starting;
mod types;
mod uncancelled;

use super::events::{Events, Side};
use crate::DevicesError;
use api::{Api, api};
use closing::Closing;
pub(super) use door::shut;
use joining::join;
use std::ffi::{CStr, CString, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;
use std::sync::{Arc, atomic::AtomicU32, atomic::Ordering};
use std::time::Duration;
use types::{
    Arg, CAPTURE_LATENCY, LatencyRange, NO_START_SERVER, PLAYBACK_LATENCY, PORT_IS_INPUT, PORT_IS_OUTPUT,
    PORT_IS_PHYSICAL, RawClient, RawPort, SERVER_NAME,
};
use uncancelled::uncancelled;
use unripple_core::clock::Instant;

/// What `jack_connect` returns for a connection that is there already: `EEXIST`.
const EXISTS: c_int = 17;

/// The work of a client in each cycle.
pub(super) trait Process: Send + 'static {
    /// One cycle, in real time unless the server freewheels.
    fn cycle(&mut self, cycle: &mut Cycle);
}

/// The buffers of one cycle.
pub(super) struct Cycle<'a> {
    api: &'static Api,
    raw: *mut RawClient,
    frames: u32,
    inputs: &'a [*mut RawPort],
    outputs: &'a [*mut RawPort],
}

impl Cycle<'_> {
    pub(super) fn frames(&self) -> usize {
        self.frames as usize
    }

    /// The server's count of samples at the beginning of the cycle, and the time of that; `None` from a server that does not know.
    pub(super) fn time(&self) -> Option<(u32, Instant)> {
        let (mut frame, mut began, mut next, mut period) = (0, 0, 0, 0.0);
        // SAFETY: the client is open while it is called; the places written to live until the call returns.
        let (failed, now) = unsafe {
            let times = self.api.get_cycle_times;
            (times(self.raw, &mut frame, &mut began, &mut next, &mut period), (self.api.get_time)())
        };
        let here = Instant::now();
        let ago = Duration::from_micros(now.saturating_sub(began));
        let ahead = Duration::from_micros(began.saturating_sub(now));
        (failed == 0).then(|| (frame, here.checked_sub(ago).unwrap_or(here) + ahead))
    }

    /// Time by the server's clock, in µs, at which the next cycle is to begin; to be read before the server counts on.
    pub(super) fn next(&self) -> Option<u64> {
        let (mut frame, mut began, mut next, mut period) = (0, 0, 0, 0.0);
        // SAFETY: as above.
        let failed =
            unsafe { (self.api.get_cycle_times)(self.raw, &mut frame, &mut began, &mut next, &mut period) };
        (failed == 0).then_some(next)
    }

    /// The server's clock now, in microseconds.
    pub(super) fn now(&self) -> u64 {
        // SAFETY: takes nothing.
        unsafe { (self.api.get_time)() }
    }

    /// Samples of an input port, by the order of registration; empty beyond the last.
    pub(super) fn input(&self, port: usize) -> &[f32] {
        let Some(port) = self.inputs.get(port) else { return &[] };
        // SAFETY: within the callback a port's buffer holds `frames` floats; inputs are only read.
        unsafe {
            let buffer = (self.api.port_get_buffer)(*port, self.frames).cast::<f32>();
            if buffer.is_null() { &[] } else { std::slice::from_raw_parts(buffer, self.frames as usize) }
        }
    }

    /// Samples of an output port, to be filled; empty beyond the last.
    pub(super) fn output(&mut self, port: usize) -> &mut [f32] {
        let Some(port) = self.outputs.get(port) else { return &mut [] };
        // SAFETY: as above; every output has a buffer of its own, and `self` is borrowed for as long as it.
        unsafe {
            let buffer = (self.api.port_get_buffer)(*port, self.frames).cast::<f32>();
            if buffer.is_null() {
                &mut []
            } else {
                std::slice::from_raw_parts_mut(buffer, self.frames as usize)
            }
        }
    }
}

/// The state that the server's callbacks are given.
struct Context {
    api: &'static Api,
    raw: *mut RawClient,
    inputs: Vec<*mut RawPort>,
    outputs: Vec<*mut RawPort>,
    process: Box<dyn Process>,
    events: Arc<Events>,
}

/// A client of a server.
pub(super) struct Client {
    api: &'static Api,
    raw: *mut RawClient,
    inputs: Vec<*mut RawPort>,
    outputs: Vec<*mut RawPort>,
    /// Once active: what the callbacks get, owned.
    context: *mut Context,
    /// Whether this client made the server run without a clock.
    freewheels: bool,
    pub(super) events: Arc<Events>,
}

// SAFETY: JACK's functions on a client may be called from any thread; the context is the callbacks' while active.
unsafe impl Send for Client {}

impl std::fmt::Debug for Client {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Client").field("name", &self.name()).finish_non_exhaustive()
    }
}

fn text(string: &str) -> Result<CString, DevicesError> {
    CString::new(string).map_err(|_| DevicesError::Jack {
        what: format!("a name with a zero byte in it: {string:?}"),
        fix: "choose another".into(),
    })
}

impl Client {
    /// A client of the named server, or of the default one; none is started.
    pub(super) fn open(name: &str, server: Option<&str>) -> Result<Self, DevicesError> {
        let api = api()?;
        let (name, server_name) = (text(name)?, text(server.unwrap_or_default())?);
        let options = NO_START_SERVER | if server.is_some() { SERVER_NAME } else { 0 };
        let status = Arc::new(AtomicU32::new(0));
        let told = status.clone();
        let raw = join(api, move || {
            let mut status = 0;
            // SAFETY: strings outlive the calls; the variadic argument is the server's name, read exactly with SERVER_NAME.
            let raw = unsafe { (api.client_open)(name.as_ptr(), options, &mut status, server_name.as_ptr()) };
            told.store(status, Ordering::Relaxed);
            raw
        })?;
        if raw.is_null() {
            return Err(DevicesError::Jack {
                what: format!(
                    "no server `{}` answers (status {:#x})",
                    server.unwrap_or("default"),
                    status.load(Ordering::Relaxed)
                ),
                fix: "start one, for example `jackd -d alsa`, or log in to a PipeWire session".into(),
            });
        }
        let (inputs, outputs, events) = (Vec::new(), Vec::new(), Arc::<Events>::default());
        // SAFETY: the events are shared until the client is closed, by this or by who closes it.
        unsafe { (api.on_shutdown)(raw, on_shutdown, Arc::as_ptr(&events).cast_mut().cast()) };
        Ok(Self { api, raw, inputs, outputs, context: ptr::null_mut(), freewheels: false, events })
    }

    /// Name of the client, as the server gave it; empty once the client is closed.
    pub(super) fn name(&self) -> String {
        if self.raw.is_null() {
            return String::new();
        }
        // SAFETY: the name lives as long as the client, and is copied.
        unsafe {
            let name = (self.api.get_client_name)(self.raw);
            if name.is_null() { String::new() } else { CStr::from_ptr(name).to_string_lossy().into_owned() }
        }
    }

    /// Samples per second.
    pub(super) fn rate(&self) -> f64 {
        // SAFETY: the client is open.
        f64::from(unsafe { (self.api.get_sample_rate)(self.raw) })
    }

    /// Samples per cycle.
    pub(super) fn period(&self) -> usize {
        // SAFETY: the client is open.
        unsafe { (self.api.get_buffer_size)(self.raw) as usize }
    }

    /// The server's count of samples at the beginning of its cycle, whether or not it calls us in it.
    pub(super) fn frame(&self) -> u32 {
        // SAFETY: the client is open.
        unsafe { (self.api.last_frame_time)(self.raw) }
    }

    /// Adds a port of this client, before [`Client::start`]: an input if `hears`, otherwise an output.
    pub(super) fn add(&mut self, name: &str, hears: bool) -> Result<(), DevicesError> {
        let (short, kind) = (text(name)?, c"32 bit float mono audio");
        let flags = if hears { PORT_IS_INPUT } else { PORT_IS_OUTPUT };
        // SAFETY: the client is open, strings outlive the call.
        let port = unsafe { (self.api.port_register)(self.raw, short.as_ptr(), kind.as_ptr(), flags, 0) };
        if port.is_null() {
            return Err(DevicesError::Jack {
                what: format!("no port `{name}` to be had"),
                fix: "names must differ and be short; the server may be out of ports".into(),
            });
        }
        if hears {
            self.inputs.push(port)
        } else {
            self.outputs.push(port)
        }
        Ok(())
    }

    /// Begins to take part in cycles, with `process` called in each. Once for each client.
    pub(super) fn start(&mut self, process: Box<dyn Process>) -> Result<(), DevicesError> {
        let context = Context {
            api: self.api,
            raw: self.raw,
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            process,
            events: self.events.clone(),
        };
        if !self.context.is_null() {
            return Ok(());
        }
        self.context = Box::into_raw(Box::new(context));
        let arg = self.context.cast::<c_void>();
        // SAFETY: the context is freed only after the client is closed.
        let failed = unsafe {
            let set = [
                (self.api.set_process_callback)(self.raw, on_process, arg),
                (self.api.set_xrun_callback)(self.raw, on_xrun, arg),
                (self.api.set_freewheel_callback)(self.raw, on_freewheel, arg),
            ];
            set.iter().any(|result| *result != 0) || (self.api.activate)(self.raw) != 0
        };
        if failed {
            let fix = "restart the server".into();
            return Err(DevicesError::Jack { what: "the client cannot be activated".into(), fix });
        }
        Ok(())
    }

    /// All audio ports of one side, by their full names, in the server's order.
    pub(super) fn ports(&self, side: Side, physical: bool) -> Vec<String> {
        let flags = if side == Side::Playback { PORT_IS_INPUT } else { PORT_IS_OUTPUT };
        let flags = if physical { flags | PORT_IS_PHYSICAL } else { flags };
        let mut names = Vec::new();
        // SAFETY: the list ends with a null pointer and is freed once; its strings are copied.
        unsafe {
            let list =
                (self.api.get_ports)(self.raw, ptr::null(), c"32 bit float mono audio".as_ptr(), flags);
            if list.is_null() {
                return names;
            }
            let mut at = list;
            while !(*at).is_null() {
                names.push(CStr::from_ptr(*at).to_string_lossy().into_owned());
                at = at.add(1);
            }
            (self.api.free)(list.cast());
        }
        names
    }

    /// Connects two ports by their full names.
    pub(super) fn connect(&self, from: &str, to: &str) -> Result<(), DevicesError> {
        let (source, sink) = (text(from)?, text(to)?);
        // SAFETY: the client is open, strings outlive the call.
        let result = unsafe { (self.api.connect)(self.raw, source.as_ptr(), sink.as_ptr()) };
        if result == 0 || result == EXISTS {
            return Ok(());
        }
        let fix = "`unripple devices` lists the ports there are".into();
        Err(DevicesError::Jack { what: format!("`{from}` cannot be connected to `{to}`"), fix })
    }

    /// Real-time priority of the thread that calls in each cycle, where it has one.
    pub(super) fn priority(&self) -> Option<u8> {
        // SAFETY: the client is open.
        let (real_time, priority) =
            unsafe { ((self.api.is_realtime)(self.raw), (self.api.client_real_time_priority)(self.raw)) };
        u8::try_from(priority).ok().filter(|priority| real_time != 0 && *priority > 0)
    }

    /// Largest latency in samples between this client's ports and the physical inputs and outputs, as the server knows it: of inputs, of
    /// outputs.
    pub(super) fn latencies(&self) -> [u64; 2] {
        let sides = [(&self.inputs, CAPTURE_LATENCY), (&self.outputs, PLAYBACK_LATENCY)];
        sides.map(|(ports, mode)| {
            let latency = |port: &*mut RawPort| {
                let mut range = LatencyRange::default();
                // SAFETY: the port is the client's, which is open; the range lives until the call returns.
                unsafe { (self.api.port_get_latency_range)(*port, mode, &mut range) };
                u64::from(range.min.max(range.max))
            };
            ports.iter().map(latency).max().unwrap_or(0)
        })
    }

    /// Closes the client: once this returns, nothing that was given to [`Client::start`] is in use any more, unless the server stands
    /// still. Such a server is left after a second, and drops what it has when it goes on. No other call may follow.
    pub(super) fn close(&mut self) {
        let raw = std::mem::replace(&mut self.raw, ptr::null_mut());
        if raw.is_null() {
            return;
        }
        let context = std::mem::replace(&mut self.context, ptr::null_mut());
        let (freewheels, events) = (self.freewheels, self.events.clone());
        Closing { api: self.api, raw, context, freewheels, events }.begin();
    }

    /// Whether the client was closed.
    pub(super) fn closed(&self) -> bool {
        self.raw.is_null()
    }

    /// Lets the server run without a clock until the client is closed.
    pub(super) fn freewheel(&mut self) -> Result<(), DevicesError> {
        // SAFETY: the client is open.
        if unsafe { (self.api.set_freewheel)(self.raw, 1) } == 0 {
            self.freewheels = true;
            return Ok(());
        }
        let fix = "not every server can; PipeWire and JACK 2 do".into();
        Err(DevicesError::Jack { what: "freewheeling cannot be switched".into(), fix })
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.close();
    }
}

unsafe extern "C-unwind" fn on_process(frames: u32, arg: Arg) -> c_int {
    uncancelled(|| {
        let context = arg.cast::<Context>();
        // SAFETY: JACK calls this on one thread, between activation and closing; no other code reaches `process` meanwhile, and
        // the other fields are only read.
        let (process, mut cycle, events) = unsafe {
            let process = &mut *ptr::addr_of_mut!((*context).process);
            let (api, raw) = (*ptr::addr_of!((*context).api), *ptr::addr_of!((*context).raw));
            let (inputs, outputs) = (&*ptr::addr_of!((*context).inputs), &*ptr::addr_of!((*context).outputs));
            (process, Cycle { api, raw, frames, inputs, outputs }, &*ptr::addr_of!((*context).events))
        };
        let done = catch_unwind(AssertUnwindSafe(|| process.cycle(&mut cycle)));
        events.cycles.fetch_add(1, Ordering::Release);
        c_int::from(done.is_err())
    })
}

/// What other callbacks may touch: the events alone, which are atomics. The context's other parts are the process callback's.
unsafe fn events<'a>(arg: Arg) -> &'a Events {
    // SAFETY: the context lives until the client is closed; only this field is reached, never the whole.
    unsafe { &*Arc::as_ptr(&*ptr::addr_of!((*arg.cast::<Context>()).events)) }
}

unsafe extern "C" fn on_xrun(arg: Arg) -> c_int {
    // SAFETY: see `events`.
    unsafe { events(arg) }.xruns.fetch_add(1, Ordering::Relaxed);
    0
}

unsafe extern "C" fn on_freewheel(starting: c_int, arg: Arg) {
    // SAFETY: see `events`.
    unsafe { events(arg) }.freewheeling.store(starting != 0, Ordering::Release);
}

unsafe extern "C-unwind" fn on_shutdown(arg: Arg) {
    uncancelled(|| {
        roll::server_gone();
        // SAFETY: the events are shared until the client is closed, and are atomics.
        unsafe { &*arg.cast::<Events>() }.gone.store(true, Ordering::Release);
    });
}
