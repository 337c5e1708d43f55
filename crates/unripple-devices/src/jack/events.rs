//! Events that the server reports to a client, kept in atomics.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;
use unripple_core::clock::Instant;

/// Number of cycles after which a change has taken effect: one may be under way already, and one begins the
/// change.
const SETTLED: u64 = 3;

/// Events of a client, as the server's callbacks report them, in atomics.
#[derive(Debug, Default)]
pub(super) struct Events {
    /// Number of cycles so far.
    pub(super) cycles: AtomicU64,
    /// Number of cycles that the server reported as late.
    pub(super) xruns: AtomicU64,
    /// Number of cycles that ended before this client had finished its part.
    pub(super) own_late: AtomicU64,
    /// Number of samples that the server has left out between cycles so far.
    pub(super) skipped: AtomicU64,
    /// Number of samples of the last cycle.
    pub(super) period: AtomicUsize,
    /// Whether the server freewheels: it runs without a clock.
    pub(super) freewheeling: AtomicBool,
    /// Whether the server is gone.
    pub(super) gone: AtomicBool,
}

/// Direction of the ports to list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Ports to which sound can be sent.
    Playback,
    /// Ports from which sound comes.
    Capture,
}

impl Events {
    /// Waits until a change that was just made has taken effect in all clients: a server applies connections
    /// at the beginning of a cycle, and a client that was late with its last cycle has no part in the first
    /// cycle after the server began to freewheel. Samples sent before are lost without notice. A server that
    /// has stopped is detected later, when a block is waited for.
    pub(super) fn settle(&self, patience: Duration) {
        let (start, cycles) = (Instant::now(), self.cycles.load(Ordering::Acquire));
        while self.cycles.load(Ordering::Acquire) < cycles + SETTLED && start.elapsed() < patience {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}
