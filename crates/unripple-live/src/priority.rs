//! Real-time priorities of the threads, below the sound server's own.

use unripple_core::Device;

/// Real-time priority that is requested, of 1 to 99, where no server states that of its own threads. Above everything
/// without real-time priority, and below the highest, which kernels keep for themselves.
const WANTED: u8 = 60;

/// Real-time priority of the other threads in the same case. Far enough below the audio thread never to delay it.
const BESIDE: u8 = 40;

/// What a granted priority is called. Windows ranks the threads of ordinary programs among themselves, and has no policy of real time.
const GRANTED: &str = if cfg!(unix) { "real time" } else { "among ordinary programs" };

/// Real-time priorities, of 1 to 99, of the threads of live play. They are lower than that of a sound server's own
/// thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Priorities {
    /// Priority of the thread that exchanges blocks, if the device does not call the player by itself.
    pub(crate) audio: Option<u8>,
    /// Priority of the thread that receives touches: they are timed when it wakes.
    pub(crate) touch: Option<u8>,
    /// Priority of the threads that turn touches into drives.
    pub(crate) beside: Option<u8>,
    /// Priority of the sound server's thread.
    server: Option<u8>,
}

impl Priorities {
    /// Priorities for live play through a device: below that of its sound server's thread, if it has one.
    pub fn of(device: &dyn Device) -> Self {
        let Some(server) = device.status().server else {
            let beside = Some(BESIDE);
            return Self { audio: Some(WANTED), touch: beside, beside, server: None };
        };
        let below = |by: u8| server.priority.and_then(|top| top.checked_sub(by)).filter(|p| *p > 0);
        Self { audio: below(1), touch: below(1), beside: below(2).or(below(1)), server: server.priority }
    }

    /// Priority of the server's thread that calls the player, in words.
    pub(crate) fn called(&self) -> String {
        match self.server {
            Some(priority) => format!("the server's own, real time, {priority} of 99"),
            None => "the server's own, ordinary: start the server with real-time priority".into(),
        }
    }
}

/// Tests whether a thread of this program can get real-time priority; returns the priority that was granted, in
/// words. A temporary thread requests it, so that no other thread's priority changes.
///
/// # Errors
/// The answer of the system if it refuses, and how to allow real-time priority.
pub fn real_time() -> Result<String, String> {
    std::thread::spawn(|| at(Some(WANTED)))
        .join()
        .unwrap_or_else(|_| Err("the thread that asked is gone".into()))
}

/// Requests a real-time priority for this thread; without one nothing is requested. Returns what was granted, in
/// words.
pub(crate) fn at(priority: Option<u8>) -> Result<String, String> {
    let Some(priority) = priority else {
        return Ok("ordinary, as the server's own threads are".into());
    };
    match request(priority) {
        Ok(()) => Ok(format!("{GRANTED}, {priority} of 99")),
        Err(error) => Err(format!(
            "ordinary: real time was refused ({error}); a line `@audio - rtprio 95` in /etc/security/limits.d allows it"
        )),
    }
}

/// Requests a priority, of 1 to 99, for this thread: on Unix under the real-time policy that runs it until it waits (FIFO), on Windows among
/// those of ordinary programs.
#[cfg(any(unix, windows))]
fn request(priority: u8) -> Result<(), String> {
    use thread_priority::{ThreadPriority, ThreadPriorityValue};
    let value = ThreadPriorityValue::try_from(priority).map_err(|error| error.to_string())?;
    let priority = ThreadPriority::Crossplatform(value);
    #[cfg(windows)]
    let set = thread_priority::set_current_thread_priority(priority);
    #[cfg(unix)]
    let set = {
        use thread_priority::unix::{
            RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
            thread_native_id,
        };
        let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
        set_thread_priority_and_policy(thread_native_id(), priority, policy)
    };
    set.map_err(|error| format!("{error:?}"))
}

/// The same where threads have no priorities.
#[cfg(not(any(unix, windows)))]
fn request(_priority: u8) -> Result<(), String> {
    Err("threads have no priorities here".into())
}
