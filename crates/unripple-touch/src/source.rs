//! The trait of whatever reports touches: screens, sockets, recordings.

use crate::{Counts, Heard};
#[cfg(unix)]
use std::os::fd::BorrowedFd;

/// How long to wait before a source is asked again that cannot say when it will have something, in s. Twice as long
/// delays a touch by as much more, half as long wakes the thread twice as often.
const PACE: f64 = 0.002;

/// Whatever reports touches.
///
/// From any source, a finger comes ([`Down`](unripple_core::Phase::Down)) before it moves, leaves once, and its number is
/// never used again; times never run back.
pub trait Source: Send {
    /// Name for people: `UDP 127.0.0.1:3333`.
    fn name(&self) -> &str;

    /// Appends what happened up to `now`, in s of the caller's clock. Never blocks, and does bounded work: what is left
    /// over comes at the next call. Call it some hundred times a second.
    fn poll(&mut self, now: f64, heard: &mut Heard);

    /// When to ask again at the latest if none of its [files](Source::files) wakes the caller before: a time in s of the clock of
    /// [`Source::poll`], or never. What cannot say is asked every 2 ms.
    fn due(&self, now: f64) -> Option<f64> {
        Some(now + PACE)
    }

    /// Appends the files and sockets that can be read as soon as there is something to poll for.
    #[cfg(unix)]
    fn files<'a>(&'a self, files: &mut Vec<BorrowedFd<'a>>) {
        let _ = files;
    }

    /// Counts of messages that were accepted and refused so far.
    fn counts(&self) -> Counts;
}
