//! Instants by a clock that the program around this one provides, with the methods of [`std::time::Instant`].

use std::ops::{Add, AddAssign, Sub};
use std::sync::OnceLock;
use std::time::Duration;

/// Function that returns the seconds since the beginning of 1970, UTC; they never decrease.
static NOW: OnceLock<fn() -> f64> = OnceLock::new();

/// Provides the clock: a function that returns the seconds since the beginning of 1970, UTC, and never less than before. The first one
/// provided stays; until then time stands still.
pub fn provide(now: fn() -> f64) {
    NOW.get_or_init(|| now);
}

/// An instant of the provided clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instant(Duration);

impl Instant {
    /// The present instant.
    pub fn now() -> Self {
        let seconds = NOW.get().map_or(0.0, |now| now());
        Self(Duration::try_from_secs_f64(seconds).unwrap_or_default())
    }

    /// Time since the beginning of 1970, UTC, to the ns.
    pub fn unix(self) -> Duration {
        self.0
    }

    /// Time since this instant, to the ns.
    pub fn elapsed(&self) -> Duration {
        Self::now().duration_since(*self)
    }

    /// Time since an earlier instant, to the ns; 0 s since a later one.
    pub fn duration_since(&self, earlier: Self) -> Duration {
        self.0.saturating_sub(earlier.0)
    }

    /// Time since an earlier instant, to the ns, as [`Instant::duration_since`] has it.
    pub fn saturating_duration_since(&self, earlier: Self) -> Duration {
        self.duration_since(earlier)
    }

    /// Time since an earlier instant, to the ns; `None` since a later one.
    pub fn checked_duration_since(&self, earlier: Self) -> Option<Duration> {
        self.0.checked_sub(earlier.0)
    }

    /// The instant that comes some time (to the ns) later; `None` if it is out of range.
    pub fn checked_add(&self, time: Duration) -> Option<Self> {
        self.0.checked_add(time).map(Self)
    }

    /// The instant that was some time (to the ns) earlier; `None` if it is before 1970.
    pub fn checked_sub(&self, time: Duration) -> Option<Self> {
        self.0.checked_sub(time).map(Self)
    }
}

impl Add<Duration> for Instant {
    type Output = Self;

    fn add(self, time: Duration) -> Self {
        Self(self.0.saturating_add(time))
    }
}

impl AddAssign<Duration> for Instant {
    fn add_assign(&mut self, time: Duration) {
        *self = *self + time;
    }
}

impl Sub<Duration> for Instant {
    type Output = Self;

    fn sub(self, time: Duration) -> Self {
        Self(self.0.saturating_sub(time))
    }
}

impl Sub for Instant {
    type Output = Duration;

    fn sub(self, earlier: Self) -> Duration {
        self.duration_since(earlier)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_provided_clock_counts_as_that_of_the_system_does() {
        assert_eq!(Instant::now().unix(), Duration::ZERO);
        provide(|| 1.7e9 + 0.25);
        provide(|| 5.0);
        let (now, second) = (Instant::now(), Duration::from_secs(1));
        assert_eq!((now.unix().as_secs(), now.elapsed()), (1_700_000_000, Duration::ZERO));
        let later = now + second;
        assert!(later > now && later - second == now);
        assert_eq!(
            (later - now, now - later, now.saturating_duration_since(later)),
            (second, Duration::ZERO, Duration::ZERO)
        );
        assert_eq!(
            (later.checked_duration_since(now), now.checked_duration_since(later)),
            (Some(second), None)
        );
        assert_eq!((now.checked_add(second), now.checked_sub(2 * now.unix())), (Some(later), None));
    }
}
