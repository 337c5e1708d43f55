//! Polls all sources of touches when one of them has something, and predicts where fingers will be at the focal
//! instant.

use std::time::Duration;
use unripple_core::{Phase, Point, Touch};
use unripple_touch::{Counts, Heard, Sources};

/// Longest wait, so that a request to stop is noticed, and shortest, should a clock stand still.
const LONGEST: Duration = Duration::from_millis(100);
const SHORTEST: Duration = Duration::from_millis(1);

/// Sources of touches, and how what they report is used.
pub(crate) struct TouchInput {
    sources: Sources,
    /// Whether a focus set off by a moving finger is aimed at its predicted place, and how far ahead that is, in s.
    predict: bool,
    window: f64,
}

/// Touches and requests of one moment.
#[derive(Clone, Debug, Default)]
pub(crate) struct TouchBatch {
    /// Time of the moment, in s of the device's clock.
    pub now: f64,
    /// Touches at the places where they were measured, and requests.
    pub heard: Heard,
    /// The same touches, each moved to the place of the finger predicted for the focal instant.
    pub aimed: Vec<Touch>,
    /// Numbers of the fingers that are down, and their places.
    pub fingers: Vec<(u64, Point)>,
    /// Counts of all sources so far.
    pub counts: Counts,
}

impl TouchBatch {
    /// Whether there are any touches or requests.
    pub fn any(&self) -> bool {
        !self.heard.touches.is_empty() || !self.heard.wishes.is_empty()
    }
}

impl TouchInput {
    /// Sources whose moving fingers are aimed `window` s ahead, if `predict` asks for it.
    pub fn new(sources: Sources, predict: bool, window: f64) -> Self {
        Self { sources, predict, window }
    }

    /// Touches and requests of all sources up to a time in s of the device's clock.
    pub fn poll(&mut self, now: f64) -> TouchBatch {
        let mut heard = Heard::default();
        self.sources.poll(now, &mut heard);
        let aim = |touch: &Touch| {
            let there = self.sources.predict(touch.finger, now, self.window);
            let moves = self.predict && touch.phase == Phase::Move;
            Touch { at: there.filter(|_| moves).unwrap_or(touch.at), ..*touch }
        };
        let aimed = heard.touches.iter().map(aim).collect();
        let fingers = self.sources.fingers().map(|(finger, motion)| (finger, motion.at())).collect();
        TouchBatch { now, heard, aimed, fingers, counts: self.sources.counts() }
    }

    /// Counts of what was accepted and refused so far.
    pub fn counts(&self) -> Counts {
        self.sources.counts()
    }

    /// Waits until a source has something to report, or for a tenth of a second; `now` is the time in s of the
    /// device's clock.
    #[cfg(unix)]
    pub fn wait(&self, now: f64) {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};
        let files = self.sources.files();
        let mut files: Vec<PollFd> = files.iter().map(|file| PollFd::new(file, PollFlags::IN)).collect();
        let patience = self.patience(now);
        if files.is_empty() {
            return std::thread::sleep(patience);
        }
        let nanoseconds = i64::from(patience.subsec_nanos());
        let patience = Timespec { tv_sec: patience.as_secs() as i64, tv_nsec: nanoseconds };
        if poll(&mut files, Some(&patience)).is_err() {
            // A signal, or a file that is gone: the source says so when it is asked.
            std::thread::sleep(SHORTEST);
        }
    }

    /// Sleeps until a source is due to be polled, but for 2 ms at most, on systems that cannot wait for files; `now` is
    /// the time in s of the device's clock.
    #[cfg(not(unix))]
    pub fn wait(&self, now: f64) {
        std::thread::sleep(self.patience(now).min(2 * SHORTEST));
    }

    fn patience(&self, now: f64) -> Duration {
        let left = self.sources.due(now).map_or(LONGEST.as_secs_f64(), |due| due - now);
        Duration::try_from_secs_f64(left).unwrap_or(SHORTEST).clamp(SHORTEST, LONGEST)
    }
}
