//! The trait of sources of touches: screens, sockets, recordings.

use crate::{Counts, Heard};
#[cfg(unix)]
use std::os::fd::BorrowedFd;

/// Time until the next poll of a source that does not state one, in s. Twice as long delays a touch by as much more,
/// half as long wakes the thread twice as often.
const PACE: f64 = 0.002;

/// A source of touches: a screen, a socket, a recording.
///
/// From any source, a finger comes down ([`Down`](unripple_core::Phase::Down)) before it moves, is lifted once, and
/// its number is never used again; times never decrease.
pub trait Source: Send {
    /// Name of the source, as shown to people: `UDP 127.0.0.1:3333`.
    fn name(&self) -> &str;

    /// Appends the touches and requests up to `now`, in s of the caller's clock. Never blocks, and does
    /// bounded work: what is left is appended by the next call. To be called some hundred times a second.
    fn poll(&mut self, now: f64, heard: &mut Heard);

    /// Latest time of the next [poll](Source::poll), in s of the caller's clock, if none of the
    /// [files](Source::files) becomes readable before; `None` for no limit. By default 2 ms after `now`.
    fn due(&self, now: f64) -> Option<f64> {
        Some(now + PACE)
    }

    /// Appends the files and sockets that become readable when there is something to poll for.
    #[cfg(unix)]
    fn files<'a>(&'a self, files: &mut Vec<BorrowedFd<'a>>) {
        let _ = files;
    }

    /// Counts of messages that were accepted and refused so far.
    fn counts(&self) -> Counts;
}
