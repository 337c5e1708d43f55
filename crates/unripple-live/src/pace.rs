//! Whether the player's clock moves.

use std::time::Duration;
use unripple_core::clock::Instant;

/// A clock that has not moved for so long stands still, unless it moves by more at a time.
const STILL: Duration = Duration::from_millis(100);

/// Longest time between two blocks that is accepted as regular, in s. With a longer one, a clock that stands still
/// would go unnoticed for longer.
const LONGEST: f64 = 0.5;

/// The player's clock beside that of the machine.
#[derive(Debug)]
pub(crate) struct Pace {
    rate: f64,
    /// The clock when it was last seen to move, and when that was.
    moved: Option<(u64, Instant)>,
    /// By how much it last moved, in s.
    by: f64,
}

impl Pace {
    /// A clock that has not moved yet, at `rate` samples per second.
    pub fn new(rate: f64) -> Self {
        Self { rate, moved: None, by: 0.0 }
    }

    /// Whether the clock, in samples, stands still at an instant: it has not moved for 0.1 s, or for twice the time
    /// by which it last moved if that is longer, so that long blocks are not mistaken for a standstill.
    pub fn stands(&mut self, clock: u64, at: Instant) -> bool {
        match self.moved {
            Some((before, since)) if before == clock => {
                let patience = STILL.max(Duration::from_secs_f64(2.0 * self.by));
                at.saturating_duration_since(since) > patience
            }
            before => {
                let moved = before.map_or(0, |(before, _)| clock.saturating_sub(before));
                self.by = (moved as f64 / self.rate).min(LONGEST);
                self.moved = Some((clock, at));
                false
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_does_not_move_stands_still() {
        let (mut pace, start) = (Pace::new(48e3), Instant::now());
        let at = |ms: u64| start + Duration::from_millis(ms);
        assert!(!pace.stands(0, at(0)) && !pace.stands(64, at(1)) && !pace.stands(64, at(90)));
        assert!(pace.stands(64, at(200)) && pace.stands(64, at(5000)));
        assert!(!pace.stands(128, at(5001)) && !pace.stands(128, at(5050)) && pace.stands(128, at(5200)));
    }

    #[test]
    fn long_blocks_are_no_standstill() {
        let (mut pace, start) = (Pace::new(48e3), Instant::now());
        for block in 0..10u64 {
            for part in [0, 60, 120, 169] {
                assert!(
                    !pace.stands(8192 * block, start + Duration::from_millis(170 * block + part))
                        || block < 2
                );
            }
        }
        assert!(pace.stands(8192 * 9, start + Duration::from_millis(170 * 9 + 400)));
    }
}
