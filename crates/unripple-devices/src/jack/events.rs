//! Events that the server reports to a client, kept in atomics.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Number of cycles after which a change is in effect: one may be under way already, and one begins the change.
const SETTLED: u64 = 3;

/// Events of a client, as the server's callbacks report them, in atomics.
#[derive(Debug, Default)]
pub(super) struct Events {
    /// Cycles so far.
    pub(super) cycles: AtomicU64,
    /// Cycles that the server says came late.
    pub(super) xruns: AtomicU64,
    /// Cycles that ended before this client's part of them was done.
    pub(super) own_late: AtomicU64,
    /// Samples that the server left out between cycles so far.
    pub(super) skipped: AtomicU64,
    /// Samples of the last cycle.
    pub(super) period: AtomicUsize,
    /// Whether the server freewheels: it runs without a clock.
    pub(super) freewheeling: AtomicBool,
    /// Whether the server is gone.
    pub(super) gone: AtomicBool,
}

/// Direction of the ports to list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Ports that sound can be sent to.
    Playback,
    /// Ports that sound comes from.
    Capture,
}

impl Events {
    /// Waits until a change that was just made is in effect in all clients: a server takes up connections at the beginning of a cycle, and
    /// a client that was late with its last cycle has no part in the first of a server that has begun to freewheel. Samples sent before are
    /// lost without notice. A server that stands still is found later, when a block is waited for.
    pub(super) fn settle(&self, patience: Duration) {
        let (start, cycles) = (Instant::now(), self.cycles.load(Ordering::Acquire));
        while self.cycles.load(Ordering::Acquire) < cycles + SETTLED && start.elapsed() < patience {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}
