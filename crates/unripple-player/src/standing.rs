//! Requests of the desk that concern the player as a whole, kept as state rather than messages, so that they cannot be
//! lost.

use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering::Acquire, Ordering::Release};

/// Requests that concern a player as a whole.
#[derive(Debug, Default)]
pub(crate) struct Standing {
    /// Drives and waveforms played once are not begun any more if their number is this or less.
    withdrawn: AtomicU64,
    /// Samples over which everything is to fade out for good; 0 while the player is to go on.
    fade: AtomicU32,
    /// Set by the player when it has faded out.
    over: AtomicBool,
}

impl Standing {
    /// Cancels the commands with numbers up to `number`.
    pub(crate) fn withdraw(&self, number: u64) {
        self.withdrawn.store(number, Release);
    }

    /// Largest number of a cancelled command.
    pub(crate) fn withdrawn(&self) -> u64 {
        self.withdrawn.load(Acquire)
    }

    /// Asks the player to end with a fade of `fade` samples.
    pub(crate) fn end(&self, fade: u32) {
        self.fade.store(fade.max(1), Release);
    }

    /// Samples of the requested fade-out; `None` while the player is to go on.
    pub(crate) fn ending(&self) -> Option<u32> {
        Some(self.fade.load(Acquire)).filter(|fade| *fade > 0)
    }

    /// Says that the player has faded out.
    pub(crate) fn set_over(&self) {
        self.over.store(true, Release);
    }

    /// Whether the player has faded out.
    pub(crate) fn is_over(&self) -> bool {
        self.over.load(Acquire)
    }
}
