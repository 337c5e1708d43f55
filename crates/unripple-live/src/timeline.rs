//! Which sample leaves the device when: what touches are timed by, and what latency is counted on.

use std::collections::VecDeque;
use std::sync::Mutex;
use std::sync::atomic::{AtomicI64, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Nothing has left yet.
const NEVER: i64 = i64::MIN;

/// Cycles that are remembered: more than pass until the player's word on them is heard.
const CYCLES: usize = 512;

/// Touches that are remembered until they are answered.
const TOUCHES: usize = 4096;

/// Set by whoever plays in each cycle, who never waits for anybody; read by whoever hears touches and whoever answers them.
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
    /// First samples of the last cycles and their origins, over and over, and how many there were.
    cycles: Vec<(AtomicU64, AtomicI64)>,
    passed: AtomicUsize,
    /// When touches came: the sample that they were timed by, and the instant.
    came: Mutex<VecDeque<(u64, Instant)>>,
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
            cycles: (0..CYCLES).map(|_| (AtomicU64::new(u64::MAX), AtomicI64::new(NEVER))).collect(),
            passed: AtomicUsize::new(0),
            came: Mutex::default(),
        }
    }

    fn ns(&self, at: Instant) -> i64 {
        let after = at.saturating_duration_since(self.base).as_nanos() as i64;
        after - self.base.saturating_duration_since(at).as_nanos() as i64
    }

    /// A cycle of so many samples, the first of which leaves at an instant; `next` is the first sample that is not computed yet.
    pub fn mark(&self, sample: u64, leaves: Instant, frames: usize, next: u64) {
        let since_zero = (sample as f64 * 1e9 / self.rate) as i64;
        let origin = self.ns(leaves) - since_zero;
        let (first, of) = &self.cycles[self.passed.fetch_add(1, Ordering::Relaxed) % CYCLES];
        of.store(origin, Ordering::Release);
        first.store(sample, Ordering::Release);
        self.origin.store(origin, Ordering::Release);
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

    /// When a sample left, or will if the device goes on as it did.
    pub fn leaves(&self, sample: u64) -> Instant {
        let cycle = |(first, origin): &(AtomicU64, AtomicI64)| {
            (first.load(Ordering::Acquire), origin.load(Ordering::Acquire))
        };
        let before = self.cycles.iter().map(cycle).filter(|(first, _)| *first <= sample);
        let Some((_, origin)) = before.max_by_key(|(first, _)| *first) else { return self.base };
        let after = origin + (sample as f64 * 1e9 / self.rate) as i64;
        self.base + Duration::from_nanos(u64::try_from(after).unwrap_or(0))
    }

    /// Touches came at an instant, and are timed as at `now`, in s of the player's clock.
    pub fn note(&self, now: f64, at: Instant) {
        if let Ok(mut came) = self.came.lock() {
            came.push_back(((now * self.rate).round() as u64, at));
            if came.len() > TOUCHES {
                came.pop_front();
            }
        }
    }

    /// Seconds from when a touch came that was timed by a sample until another sample leaves: whatever the device left out between them
    /// is in it.
    pub fn between(&self, touch: u64, sample: u64) -> f64 {
        let noted =
            self.came.lock().ok().and_then(|came| came.iter().find(|(timed, _)| *timed == touch).copied());
        let came = noted.map_or_else(|| self.leaves(touch), |(_, at)| at);
        self.leaves(sample).saturating_duration_since(came).as_secs_f64()
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
        let found = line.at(start + Duration::from_secs(2)) * 48e3;
        assert!((found - 992.0).abs() < 1e-6, "{found}");
        // And one that goes on later goes on from there.
        line.mark(736, start + Duration::from_secs(2), 256, 992);
        let found = line.at(start + Duration::from_secs(2)) * 48e3;
        assert!((found - 736.0).abs() < 1e-3, "{found}");
    }

    #[test]
    fn latency_holds_what_the_device_left_out() {
        let (line, start) = (Timeline::new(48e3), Instant::now());
        let at = |samples: f64| start + Duration::from_secs_f64(samples / 48e3);
        line.mark(0, start, 256, 256);
        // A touch in the midst of a cycle, which a device in step answers in the next.
        let touched = line.at(at(100.0));
        line.note(touched, at(100.0));
        line.mark(256, at(256.0), 256, 512);
        assert!((line.between(100, 256) * 48e3 - 156.0).abs() < 0.01);
        // One that is answered after a gap, and told of some cycles later.
        let touched = (line.at(at(300.0)) * 48e3).round() as u64;
        line.note(touched as f64 / 48e3, at(300.0));
        line.mark(512, at(5512.0), 256, 768);
        line.mark(768, at(9768.0), 256, 1024);
        assert!((line.between(touched, 512) * 48e3 - 5212.0).abs() < 0.01);
        // One that the device's own clock knows no sample for.
        let touched = (line.at(at(20_000.0)) * 48e3).round() as u64;
        line.note(touched as f64 / 48e3, at(20_000.0));
        line.mark(1024, at(30_000.0), 256, 1280);
        assert!((line.between(touched, 1024) * 48e3 - 10_000.0).abs() < 0.01);
    }

    #[test]
    fn who_sleeps_is_woken_once() {
        let line = Timeline::new(48e3);
        assert!(!line.rings(1 << 40));
        line.wake_at(128);
        assert_eq!([64, 128, 192].map(|next| line.rings(next)), [false, true, false]);
    }
}
