//! When each sample leaves the device: the time base for touches and for latency.

use std::collections::VecDeque;
use std::sync::Mutex;
use std::sync::atomic::{AtomicI64, AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;
use unripple_core::clock::Instant;

/// Stands for "nothing has left yet", a time that no clock shows.
const NEVER: i64 = i64::MIN;

/// Cycles that are remembered: more than pass until the player's report on them arrives.
const CYCLES: usize = 512;

/// Touches that are remembered until they are answered. The oldest go first; their latency is not known then.
const TOUCHES: usize = 4096;

/// Times at which samples leave the device. The audio thread sets it in each cycle without ever waiting; the threads
/// that receive touches and answer them read it.
#[derive(Debug)]
pub(crate) struct Timeline {
    base: Instant,
    rate: f64,
    /// When sample 0 would have left, extrapolated from the last cycle, in ns after the base.
    origin: AtomicI64,
    /// The first sample that is not computed yet.
    next: AtomicU64,
    /// Samples of the last cycle.
    period: AtomicUsize,
    /// The sample from which on a thread wants to be woken.
    wake: AtomicU64,
    /// Ring buffer of the last cycles, with the first sample and origin of each, and the number of cycles so far.
    cycles: Vec<(AtomicU64, AtomicI64)>,
    passed: AtomicUsize,
    /// The first sample that no touch is timed by yet.
    fresh: AtomicU64,
    /// Touches: the sample that each was timed by, and the instant at which it came.
    came: Mutex<VecDeque<(u64, Instant)>>,
}

impl Timeline {
    /// A timeline before any sample has left the device, at `rate` samples per second.
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
            fresh: AtomicU64::new(0),
            came: Mutex::default(),
        }
    }

    fn ns(&self, at: Instant) -> i64 {
        let after = at.saturating_duration_since(self.base).as_nanos() as i64;
        after - self.base.saturating_duration_since(at).as_nanos() as i64
    }

    /// Records a cycle of `frames` samples, whose first is `sample` and leaves at an instant; `next` is the first
    /// sample that is not computed yet.
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

    /// The time, in s of the player's clock, of the sample that leaves the device at an instant. It is at
    /// most one cycle after the first sample that is not computed yet, however long the device stands still.
    /// Touches that come meanwhile stay distinct: each is timed a sample after the one before, for another
    /// cycle at most.
    pub fn at(&self, instant: Instant) -> f64 {
        let next = self.next.load(Ordering::Acquire) as f64 / self.rate;
        let ahead = self.period() as f64 / self.rate;
        match self.origin.load(Ordering::Acquire) {
            NEVER => next,
            origin => {
                let found = (1e-9 * (self.ns(instant) - origin) as f64).clamp(0.0, next + ahead);
                let fresh = self.fresh.load(Ordering::Acquire) as f64 / self.rate;
                found.max(fresh.min(next + 2.0 * ahead))
            }
        }
    }

    /// Instant at which a sample left, or will leave if the device continues at its pace; the start of the
    /// timeline if the cycle of the sample is no longer remembered.
    pub fn leaves(&self, sample: u64) -> Instant {
        self.known(sample).unwrap_or(self.base)
    }

    /// As [`Timeline::leaves`], or none if the cycle of the sample is no longer remembered.
    fn known(&self, sample: u64) -> Option<Instant> {
        let cycle = |(first, origin): &(AtomicU64, AtomicI64)| {
            (first.load(Ordering::Acquire), origin.load(Ordering::Acquire))
        };
        let before = self.cycles.iter().map(cycle).filter(|(first, _)| *first <= sample);
        let (_, origin) = before.max_by_key(|(first, _)| *first)?;
        let after = origin + (sample as f64 * 1e9 / self.rate) as i64;
        Some(self.base + Duration::from_nanos(u64::try_from(after).unwrap_or(0)))
    }

    /// Records that touches, timed as at `now` (s of the player's clock), came at the instant `at`.
    pub fn note(&self, now: f64, at: Instant) {
        let sample = (now * self.rate).round() as u64;
        self.fresh.fetch_max(sample + 1, Ordering::AcqRel);
        if let Ok(mut came) = self.came.lock() {
            came.push_back((sample, at));
            if came.len() > TOUCHES {
                came.pop_front();
            }
        }
    }

    /// Time in s from the arrival of the touch timed by the sample `touch` until the sample `sample` leaves
    /// the device, including any gap of the device between them. NaN once one of the two is no longer
    /// remembered.
    pub fn between(&self, touch: u64, sample: u64) -> f64 {
        let noted =
            self.came.lock().ok().and_then(|came| came.iter().find(|(timed, _)| *timed == touch).copied());
        let came = noted.map_or_else(|| self.known(touch), |(_, at)| Some(at));
        let (Some(came), Some(leaves)) = (came, self.known(sample)) else { return f64::NAN };
        leaves.saturating_duration_since(came).as_secs_f64()
    }

    /// Number of samples in the last cycle.
    pub fn period(&self) -> usize {
        self.period.load(Ordering::Acquire)
    }

    /// Whether a thread has requested to be woken, now that the samples before `next` are computed; true
    /// only once.
    pub fn rings(&self, next: u64) -> bool {
        let rings = next >= self.wake.load(Ordering::Acquire);
        if rings {
            self.wake.store(u64::MAX, Ordering::Release);
        }
        rings
    }

    /// Requests that the waiting thread be woken once all samples before `sample` are computed.
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
        // One that is answered after a gap, and reported some cycles later.
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
    fn touches_of_a_device_that_stands_still_are_told_apart() {
        let (line, start) = (Timeline::new(48e3), Instant::now());
        line.mark(0, start, 256, 256);
        let came = |i: u32| start + Duration::from_millis(100) * (i + 1);
        let timed: Vec<u64> = (0..20)
            .map(|i| {
                let now = line.at(came(i));
                line.note(now, came(i));
                (now * 48e3).round() as u64
            })
            .collect();
        assert!(timed.iter().all(|sample| *sample <= 256 + 2 * 256), "{timed:?}");
        line.mark(256, start + Duration::from_secs(5), 256, 512);
        for (i, touch) in (0..).zip(&timed) {
            let wanted = (start + Duration::from_secs(5) - came(i)).as_secs_f64();
            assert!((line.between(*touch, 256) - wanted).abs() < 1e-6, "touch {i} of {timed:?}");
        }
        // Once it goes on, touches are timed as ever.
        line.mark(1024, start + Duration::from_secs(6), 256, 1280);
        assert!((line.at(start + Duration::from_secs(6)) * 48e3 - 1024.0).abs() < 1e-3);
    }

    #[test]
    fn what_is_forgotten_is_no_latency_of_nothing() {
        let (line, start) = (Timeline::new(48e3), Instant::now());
        line.note(0.0, start);
        let cycle = |i: u64| {
            line.mark(256 * i, start + Duration::from_secs_f64(256.0 * i as f64 / 48e3), 256, 256 * (i + 1))
        };
        (0..CYCLES as u64).for_each(cycle);
        assert!((line.between(0, 256) - 256.0 / 48e3).abs() < 1e-6);
        (CYCLES as u64..CYCLES as u64 + 2).for_each(cycle);
        // The cycle of sample 256 is forgotten, and so is that of a touch that nobody noted.
        assert!(line.between(0, 256).is_nan() && line.between(1, 256 * 400).is_nan());
        assert!((line.between(0, 512) - 512.0 / 48e3).abs() < 1e-6);
    }

    #[test]
    fn who_sleeps_is_woken_once() {
        let line = Timeline::new(48e3);
        assert!(!line.rings(1 << 40));
        line.wake_at(128);
        assert_eq!([64, 128, 192].map(|next| line.rings(next)), [false, true, false]);
    }
}
