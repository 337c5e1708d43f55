//! Holds: a comb, loop or looped waveform sounds only as long as its hold is kept.

use crate::At;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Acquire, Ordering::Relaxed, Ordering::Release};

/// No sample: nobody has said so yet. The largest there is, so that "before" needs no special case.
const NEVER: u64 = u64::MAX;

/// In the place of a fade: begun copies of a drive ring out. No fade is as long.
const RING: u32 = u32::MAX;

/// Keeps something in the player going; once it is stopped or dropped, the player ends it. Nothing is sent for that and nothing has to find
/// room, so it cannot be lost or refused; it takes hold with the next block.
///
/// ```
/// use std::sync::Arc;
/// use unripple_player::{At, Command, Options, Prepared, Voice, player};
///
/// let (mut player, mut desk) = player(&Options { outputs: 1, ..Options::default() })?;
/// let drive = Arc::new(Prepared::new(1, vec![0.5])?);
/// let comb = Command::Start { voice: Voice(1), drive, at: At::Now, gain: 1.0, period: Some(64.0) };
/// let hold = desk.hold(comb).map_err(|_| "no room")?;
/// let mut block = [0.0; 64];
/// player.process(&mut block);
/// assert_eq!(block[0], 0.5);
/// drop(hold);
/// player.process(&mut block);
/// assert_eq!(block[0], 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Hold(pub(crate) Arc<Held>);

impl Hold {
    /// Ends it from a sample on. What sounds fades over so many samples, at least a block; `None` lets begun copies of a drive ring out.
    pub fn stop(&self, at: At, fade: Option<u32>) {
        let until = match at {
            At::Now => 0,
            At::Sample(sample) => sample.min(NEVER - 1),
        };
        self.0.fade.store(fade.map_or(RING, |fade| fade.min(RING - 1)), Relaxed);
        self.0.until.store(until, Release);
    }

    /// Whether somebody has stopped it.
    pub fn is_stopped(&self) -> bool {
        self.0.until() != NEVER
    }

    /// A sample from which on it is silent, once the player has said so: it was stopped, is over by itself, or was refused.
    pub fn over(&self) -> Option<u64> {
        Some(self.0.over.load(Acquire)).filter(|over| *over != NEVER)
    }
}

impl Drop for Hold {
    fn drop(&mut self) {
        if !self.is_stopped() {
            self.stop(At::Now, None);
        }
    }
}

/// What both sides know of something that is held.
#[derive(Debug)]
pub(crate) struct Held {
    /// From which sample on it is not wanted any more.
    until: AtomicU64,
    fade: AtomicU32,
    /// From which sample on it is silent: said by the player.
    over: AtomicU64,
}

impl Held {
    /// Held without end, and not over yet.
    pub(crate) fn new() -> Self {
        Self { until: AtomicU64::new(NEVER), fade: AtomicU32::new(RING), over: AtomicU64::new(NEVER) }
    }

    /// Sample of the clock from which on it is not wanted any more.
    pub(crate) fn until(&self) -> u64 {
        self.until.load(Acquire)
    }

    /// Samples of its fade; `None` to ring out.
    pub(crate) fn fade(&self) -> Option<u32> {
        Some(self.fade.load(Relaxed)).filter(|fade| *fade != RING)
    }

    /// Says from which sample on it is silent.
    pub(crate) fn set_over(&self, sample: u64) {
        self.over.store(sample.min(NEVER - 1), Release);
    }
}
