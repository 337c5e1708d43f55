//! Which sample leaves the device when: what touches are timed by, and what latency is counted on.

use std::sync::atomic::{AtomicI64, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Nothing has left yet.
const NEVER: i64 = i64::MIN;

/// Set by whoever plays in each cycle, read by whoever hears touches. Nobody locks it.
#[derive(Debug)]
pub(crate) struct Timeline {
    base: Instant,
    rate: f64,
    /// When sample 0 would have left, by where the last cycle stood, in ns after the base.
    origin: AtomicI64,
    /// The first sample that is not computed yet.
    next: AtomicU64,
    /// Samples of the last cycle.
    period: AtomicUsize,
    /// The sample from which on somebody wants to be woken.
    wake: AtomicU64,
}

impl Timeline {
    /// Nothing has left yet, at so many samples per second.
    pub fn new(rate: f64) -> Self {
        Self {
            base: Instant::now(),
            rate,
            origin: AtomicI64::new(NEVER),
            next: AtomicU64::new(0),
            period: AtomicUsize::new(0),
            wake: AtomicU64::new(u64::MAX),
        }
    }

    fn ns(&self, at: Instant) -> i64 {
        let after = at.saturating_duration_since(self.base).as_nanos() as i64;
        after - self.base.saturating_duration_since(at).as_nanos() as i64
    }

    /// A cycle of so many samples, the first of which leaves at an instant; `next` is the first sample that is not computed yet.
    pub fn mark(&self, sample: u64, leaves: Instant, frames: usize, next: u64) {
        let since_zero = (sample as f64 * 1e9 / self.rate) as i64;
        self.origin.store(self.ns(leaves) - since_zero, Ordering::Release);
        self.period.store(frames, Ordering::Release);
        self.next.store(next, Ordering::Release);
    }

    /// The sample that leaves at an instant, in s of the player's clock: within a cycle of the first one that is not computed yet, however
    /// long the device stands still.
    pub fn at(&self, instant: Instant) -> f64 {
        let next = self.next.load(Ordering::Acquire) as f64 / self.rate;
        match self.origin.load(Ordering::Acquire) {
            NEVER => next,
            origin => {
                let ahead = self.period() as f64 / self.rate;
                (1e-9 * (self.ns(instant) - origin) as f64).clamp(0.0, next + ahead)
            }
        }
    }

    /// When a sample leaves, if the device goes on as it did.
    pub fn leaves(&self, sample: u64) -> Instant {
        let origin = self.origin.load(Ordering::Acquire);
        if origin == NEVER {
            return self.base;
        }
        let after = origin + (sample as f64 * 1e9 / self.rate) as i64;
        self.base + Duration::from_nanos(u64::try_from(after).unwrap_or(0))
    }

    /// The sample that leaves now, in s.
    pub fn now(&self) -> f64 {
        self.at(Instant::now())
    }

    /// Samples of the last cycle.
    pub fn period(&self) -> usize {
        self.period.load(Ordering::Acquire)
    }

    /// Whether somebody wants to be woken now that samples before `next` are computed; only once.
    pub fn rings(&self, next: u64) -> bool {
        let rings = next >= self.wake.load(Ordering::Acquire);
        if rings {
            self.wake.store(u64::MAX, Ordering::Release);
        }
        rings
    }

    /// Asks to be woken once all samples before one are computed.
    pub fn wake_at(&self, sample: u64) {
        self.wake.store(sample, Ordering::Release);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_instant_is_the_sample_that_leaves_then() {
        let line = Timeline::new(48e3);
        let start = Instant::now();
        assert_eq!(line.at(start), 0.0);
        line.mark(480, start, 256, 736);
        for samples in [0.0, 1.0, 100.0, 255.0] {
            let found = line.at(start + Duration::from_secs_f64(samples / 48e3)) * 48e3;
            assert!((found - 480.0 - samples).abs() < 1e-3, "{found}");
        }
        // A device that stands still does not let time run ahead of it.
        assert_eq!(line.at(start + Duration::from_secs(2)) * 48e3, (736.0 + 256.0) / 48e3 * 48e3);
        // And one that goes on later goes on from there.
        line.mark(736, start + Duration::from_secs(2), 256, 992);
        let found = line.at(start + Duration::from_secs(2)) * 48e3;
        assert!((found - 736.0).abs() < 1e-3, "{found}");
    }

    #[test]
    fn who_sleeps_is_woken_once() {
        let line = Timeline::new(48e3);
        assert!(!line.rings(1 << 40));
        line.wake_at(128);
        assert_eq!([64, 128, 192].map(|next| line.rings(next)), [false, true, false]);
    }
}
