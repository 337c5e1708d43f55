//! Check whether a thread of this program makes progress, from the kernel's counters.

use std::path::PathBuf;

/// A thread, by its folder in Linux's `/proc`.
pub(super) struct Caller(PathBuf);

/// The activity of a thread so far: whether it is running or ready to run, and its time on a processor.
#[derive(PartialEq)]
pub(super) struct Activity {
    /// Whether the thread is running or would run if a processor were free.
    pub(super) waits_for_a_processor: bool,
    /// Times on a processor and in the queue for one, in nanoseconds, and how often it was given one.
    scheduled: String,
}

impl Caller {
    /// The calling thread; `None` if the kernel does not report its activity.
    pub(super) fn this_thread() -> Option<Self> {
        let folder = PathBuf::from("/proc").join(std::fs::read_link("/proc/thread-self").ok()?);
        folder.join("schedstat").exists().then_some(Self(folder))
    }

    /// The activity of the thread so far; `None` if it has ended.
    pub(super) fn activity(&self) -> Option<Activity> {
        let stat = std::fs::read_to_string(self.0.join("stat")).ok()?;
        // The state stands behind the name, which may hold brackets itself.
        let waits_for_a_processor = stat.rsplit_once(") ").is_some_and(|(_, rest)| rest.starts_with('R'));
        let scheduled = std::fs::read_to_string(self.0.join("schedstat")).ok()?;
        Some(Activity { waits_for_a_processor, scheduled })
    }
}
