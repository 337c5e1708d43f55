//! All sources of touches, polled when one of them has something, and where fingers will be when waves reach them.

use std::time::Duration;
use unripple_core::{Phase, Point, Touch};
use unripple_touch::{Counts, Heard, Sources};

/// Longest wait, so that a wish to stop is noticed, and shortest, should a clock stand still.
const LONGEST: Duration = Duration::from_millis(100);
const SHORTEST: Duration = Duration::from_millis(1);

/// Sources of touches, and how what they report is used.
pub(crate) struct Ears {
    sources: Sources,
    /// Whether what a moving finger sets off is aimed where it will be, and how far ahead that is, in s.
    predict: bool,
    window: f64,
}

/// Touches and wishes of one moment.
#[derive(Clone, Debug, Default)]
pub(crate) struct News {
    /// When, in s of the device's clock.
    pub now: f64,
    /// Touches as they were, and wishes.
    pub heard: Heard,
    /// The same touches, moved to where the finger will be when the waves meet.
    pub aimed: Vec<Touch>,
    /// Fingers that are there, and where.
    pub fingers: Vec<(u64, Point)>,
    /// Counts of all sources so far.
    pub counts: Counts,
}

impl News {
    /// Whether anything happened.
    pub fn any(&self) -> bool {
        !self.heard.touches.is_empty() || !self.heard.wishes.is_empty()
    }
}

impl Ears {
    /// Sources whose moving fingers are aimed `window` s ahead, if `predict` asks for it.
    pub fn new(sources: Sources, predict: bool, window: f64) -> Self {
        Self { sources, predict, window }
    }

    /// Touches and wishes of all sources up to a time in s of the device's clock.
    pub fn hear(&mut self, now: f64) -> News {
        let mut heard = Heard::default();
        self.sources.poll(now, &mut heard);
        let aim = |touch: &Touch| {
            let there = self.sources.predict(touch.finger, now, self.window);
            let moves = self.predict && touch.phase == Phase::Move;
            Touch { at: there.filter(|_| moves).unwrap_or(touch.at), ..*touch }
        };
        let aimed = heard.touches.iter().map(aim).collect();
        let fingers = self.sources.fingers().map(|(finger, motion)| (finger, motion.at())).collect();
        News { now, heard, aimed, fingers, counts: self.sources.counts() }
    }

    /// Numbers of what was taken in and refused so far.
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

    /// Waits where nothing wakes, by the pace at which sources are polled; `now` is the time in s of the device's
    /// clock.
    #[cfg(not(unix))]
    pub fn wait(&self, now: f64) {
        std::thread::sleep(self.patience(now).min(2 * SHORTEST));
    }

    fn patience(&self, now: f64) -> Duration {
        let left = self.sources.due(now).map_or(LONGEST.as_secs_f64(), |due| due - now);
        Duration::try_from_secs_f64(left).unwrap_or(SHORTEST).clamp(SHORTEST, LONGEST)
    }
}
