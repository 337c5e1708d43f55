//! Check whether a server still calls its client in its cycles.

use std::time::Duration;
use unripple_core::clock::Instant;

/// Number of successive checks that find the server running and the client not called, after which the
/// client counts as left out: the first check after a server had stopped may come just before it calls.
const LOOKS: u32 = 3;

/// The server's counts of cycles and samples at the last check.
#[derive(Debug)]
pub(super) struct Watch {
    /// Number of cycles when the last one was seen to pass, and the time of that.
    cycles: u64,
    at: Instant,
    /// The server's sample count at the last check since then, and the number of successive checks that
    /// found it changed.
    frame: u32,
    moved: u32,
}

/// Progress of the server's cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pace {
    /// This number of cycles has passed since the last check.
    Passed(u64),
    /// No cycle passed, but for less than the patience.
    Waiting,
    /// No cycle passed for longer than the patience: the server has stopped.
    Stands(Duration),
    /// The server runs without calling its client.
    LeftOut(Duration),
}

impl Watch {
    /// A watch that begins now, when `cycles` cycles have passed.
    pub(super) fn new(cycles: u64) -> Self {
        Self { cycles, at: Instant::now(), frame: 0, moved: 0 }
    }

    /// The time at which a cycle was last seen to pass; now, if `cycles` shows that more have passed.
    pub(super) fn last(&self, cycles: u64) -> Instant {
        if cycles > self.cycles { Instant::now() } else { self.at }
    }

    /// Checks the progress, given the number of cycles so far. The server's own sample count is read only if
    /// no cycle has passed for longer than the patience.
    pub(super) fn look(&mut self, cycles: u64, patience: Duration, frame: impl FnOnce() -> u32) -> Pace {
        let (more, since) = (cycles - self.cycles, self.at.elapsed());
        if more > 0 {
            *self = Self::new(cycles);
            return Pace::Passed(more);
        }
        if since < patience {
            return Pace::Waiting;
        }
        let frame = frame();
        self.moved = if frame == std::mem::replace(&mut self.frame, frame) { 0 } else { self.moved + 1 };
        if self.moved >= LOOKS { Pace::LeftOut(since) } else { Pace::Stands(since) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_server_that_stands_still_is_told_from_one_that_goes_on_without_us() {
        let mut watch = Watch::new(5);
        assert_eq!(watch.look(7, Duration::ZERO, || 0), Pace::Passed(2));
        assert_eq!(watch.look(7, Duration::from_secs(1000), || 1), Pace::Waiting);
        for frame in [256, 256, 512, 768, 768, 1024, 1280] {
            assert!(matches!(watch.look(7, Duration::ZERO, || frame), Pace::Stands(_)));
        }
        assert!(matches!(watch.look(7, Duration::ZERO, || 1536), Pace::LeftOut(_)));
        assert_eq!(watch.look(8, Duration::ZERO, || 1792), Pace::Passed(1));
    }
}
