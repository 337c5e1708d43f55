//! Holds: handles by which combs, loops and looped waveforms are ended.

use crate::At;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Acquire, Ordering::Relaxed, Ordering::Release};

/// In place of a sample: not set yet. The largest number there is, so that "before" needs no special case.
const NEVER: u64 = u64::MAX;

/// In place of a fade: copies of a drive that have begun play to their end. No fade is as long.
const RING: u32 = u32::MAX;

/// Handle of a comb (a drive repeated with a period), loop or looped waveform, which plays until the handle is stopped
/// or dropped. The player reads the state of all handles at each block: stopping needs no message and no room in a
/// queue, so it cannot be lost or refused. It takes effect with the next block.
///
/// ```
/// use std::sync::Arc;
/// use unripple_player::{At, Command, Options, PreparedDrive, Voice, player};
///
/// let (mut player, mut desk) = player(&Options { outputs: 1, ..Options::default() })?;
/// let drive = Arc::new(PreparedDrive::new(1, vec![0.5])?);
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
    /// Ends the drive or waveform from a sample on, with a fade-out of `fade` samples (at least a block).
    /// With `None`, copies of a drive that have begun play to their end.
    pub fn stop(&self, at: At, fade: Option<u32>) {
        let until = match at {
            At::Now => 0,
            At::Sample(sample) => sample.min(NEVER - 1),
        };
        self.0.fade.store(fade.map_or(RING, |fade| fade.min(RING - 1)), Relaxed);
        self.0.until.store(until, Release);
    }

    /// Whether [`Hold::stop`] has been called.
    pub fn is_stopped(&self) -> bool {
        self.0.until() != NEVER
    }

    /// Sample of the player's clock from which on the drive or waveform is silent, because it was stopped,
    /// ended by itself or was refused; `None` until the player has reported that.
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

/// State of a hold, shared by desk and player.
#[derive(Debug)]
pub(crate) struct Held {
    /// Sample from which on it is to be ended.
    until: AtomicU64,
    fade: AtomicU32,
    /// Sample from which on it is silent, set by the player.
    over: AtomicU64,
}

impl Held {
    /// A hold that has been neither stopped nor reported as over.
    pub(crate) fn new() -> Self {
        Self { until: AtomicU64::new(NEVER), fade: AtomicU32::new(RING), over: AtomicU64::new(NEVER) }
    }

    /// Sample of the clock from which on the drive or waveform is to be ended.
    pub(crate) fn until(&self) -> u64 {
        self.until.load(Acquire)
    }

    /// Length of the fade-out in samples; `None` to let begun copies play to their end.
    pub(crate) fn fade(&self) -> Option<u32> {
        Some(self.fade.load(Relaxed)).filter(|fade| *fade != RING)
    }

    /// Sets the sample from which on the drive or waveform is silent.
    pub(crate) fn set_over(&self, sample: u64) {
        self.over.store(sample.min(NEVER - 1), Release);
    }
}
