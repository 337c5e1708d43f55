use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize};

/// What happens to a client, told by atomics.
#[derive(Debug, Default)]
pub(super) struct Events {
    /// Cycles so far.
    pub(super) cycles: AtomicU64,
    /// Cycles that the server says came late.
    pub(super) xruns: AtomicU64,
    /// Cycles that were over before our part of them was done.
    pub(super) own_late: AtomicU64,
    /// Samples that the server left out between cycles so far.
    pub(super) skipped: AtomicU64,
    /// Samples of the last cycle.
    pub(super) period: AtomicUsize,
    /// Whether the server waits for nobody's clock.
    pub(super) freewheeling: AtomicBool,
    /// Whether the server is gone.
    pub(super) gone: AtomicBool,
}

/// Which ports to list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Those that sound can be sent to.
    Playback,
    /// Those that sound comes from.
    Capture,
}
