use thread_priority::{
    RealtimeThreadSchedulePolicy, ThreadPriority, ThreadPriorityValue, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};

/// Priority that is asked for, of 1 to 99: below that of a sound server's own threads.
const WANTED: u8 = 60;

/// Priority of the threads that hear touches and make drives: below that of the sound.
const BESIDE: u8 = 40;

/// Asks for real-time priority for this thread, and says what came of it.
pub(crate) fn ask() -> String {
    real_time().unwrap_or_else(|refused| refused)
}

/// Real-time priority for the calling thread: what was granted, or why nothing was and how to have it.
///
/// # Errors
/// What the system answered.
pub fn real_time() -> Result<String, String> {
    at(WANTED)
}

/// The same for a thread that works for the audio thread.
pub(crate) fn beside() -> Result<String, String> {
    at(BESIDE)
}

fn at(priority: u8) -> Result<String, String> {
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
