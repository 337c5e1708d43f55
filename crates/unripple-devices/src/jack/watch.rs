//! Whether a server's cycles still reach its client.

use std::time::{Duration, Instant};

/// Number of looks in a row that find the server running and the client not called, after which the client counts as left out: the
/// first look after a server stood still may come just before it calls.
const LOOKS: u32 = 3;

/// The server's cycles and samples as last seen.
#[derive(Debug)]
pub(super) struct Watch {
    /// Cycles when one was last seen to pass, and when that was.
    cycles: u64,
    at: Instant,
    /// The server's count of samples at the last look since, and looks in a row that found it moved.
    frame: u32,
    moved: u32,
}

/// Progress of the server's cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pace {
    /// So many cycles passed since the last look.
    Passed(u64),
    /// No cycle passed, but the patience is not over yet.
    Waiting,
    /// No cycle passed for longer than the patience: the server stands still.
    Stands(Duration),
    /// The server goes on without its client.
    LeftOut(Duration),
}

impl Watch {
    /// A watch from now on, when `cycles` cycles have passed.
    pub(super) fn new(cycles: u64) -> Self {
        Self { cycles, at: Instant::now(), frame: 0, moved: 0 }
    }

    /// When a cycle was last seen to pass; now, if more have passed than were seen.
    pub(super) fn last(&self, cycles: u64) -> Instant {
        if cycles > self.cycles { Instant::now() } else { self.at }
    }

    /// Looks at the progress, after so many cycles. The server's own count of samples is asked for only when none passed for too
    /// long.
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
