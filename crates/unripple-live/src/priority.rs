//! Real-time priorities of the threads, below the sound server's own.

use thread_priority::{
    RealtimeThreadSchedulePolicy, ThreadPriority, ThreadPriorityValue, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};
use unripple_core::Device;

/// Priority that is asked for, of 1 to 99, where no server says what its own threads have. Above everything without
/// real-time priority, and below the highest, which kernels keep for themselves.
const WANTED: u8 = 60;

/// Priority of the threads that work for the one that plays, likewise. Far enough below the audio thread never to
/// delay it.
const BESIDE: u8 = 40;

/// Real-time priorities of the threads of a play: never as high as that of the server's thread that calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Priorities {
    /// Of the thread that exchanges blocks, if the device does not call by itself.
    pub(crate) audio: Option<u8>,
    /// Of the thread that receives touches: they are timed when it wakes.
    pub(crate) touch: Option<u8>,
    /// Of the threads that turn them into drives.
    pub(crate) beside: Option<u8>,
    /// Of the server's own thread.
    server: Option<u8>,
}

impl Priorities {
    /// The priorities that suit a device.
    pub fn of(device: &dyn Device) -> Self {
        let Some(server) = device.status().server else {
            let beside = Some(BESIDE);
            return Self { audio: Some(WANTED), touch: beside, beside, server: None };
        };
        let below = |by: u8| server.priority.and_then(|top| top.checked_sub(by)).filter(|p| *p > 0);
        Self { audio: below(1), touch: below(1), beside: below(2).or(below(1)), server: server.priority }
    }

    /// What the thread has that calls, in words.
    pub(crate) fn called(&self) -> String {
        match self.server {
            Some(priority) => format!("the server's own, real time, {priority} of 99"),
            None => "the server's own, ordinary: start the server with real-time priority".into(),
        }
    }
}

/// Whether a thread of this program may have real-time priority: what is granted, or why nothing is and how to have it. A thread of its
/// own asks, so that nobody keeps it.
///
/// # Errors
/// Why nothing is granted, as the system answered.
pub fn real_time() -> Result<String, String> {
    std::thread::spawn(|| at(Some(WANTED)))
        .join()
        .unwrap_or_else(|_| Err("the thread that asked is gone".into()))
}

/// The same for a given priority; without one nothing is asked for.
pub(crate) fn at(priority: Option<u8>) -> Result<String, String> {
    let Some(priority) = priority else {
        return Ok("ordinary, as the server's own threads are".into());
    };
    let value = ThreadPriorityValue::try_from(priority).map_err(|e| e.to_string())?;
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    let wanted = ThreadPriority::Crossplatform(value);
    match set_thread_priority_and_policy(thread_native_id(), wanted, policy) {
        Ok(()) => Ok(format!("real time, {priority} of 99")),
        Err(error) => Err(format!(
            "ordinary: real time was refused ({error:?}); a line `@audio - rtprio 95` in /etc/security/limits.d allows it"
        )),
    }
}
