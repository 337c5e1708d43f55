//! Several sources as one, with velocity and prediction.

use crate::{Counts, Heard, Motion, Source};
#[cfg(unix)]
use std::os::fd::BorrowedFd;
use unripple_core::{Outline, Phase, Point, Touch};

/// Fingers at once over all sources; more are counted and dropped.
const MOST: usize = 128;
/// Largest distance of a predicted place from the last one, in m. A finger at 0.3 m/s covers it in 67 ms, about a
/// focusing window; a wrong velocity moves a focus by no more.
const REACH: f64 = 0.02;

#[derive(Clone, Debug)]
struct Followed {
    source: usize,
    theirs: u64,
    ours: u64,
    motion: Motion,
}

/// Several sources as one: gives fingers numbers that are unique over all of them, and follows how each moves.
///
/// ```
/// use unripple_core::{Outline, Shape};
/// use unripple_touch::{Heard, Sources, Synthetic, SyntheticOptions};
///
/// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
/// let mut sources = Sources::new(&sheet);
/// sources.push(Box::new(Synthetic::new(&sheet, SyntheticOptions::default())?));
/// let mut heard = Heard::default();
/// for step in 0..500 {
///     sources.poll(0.002 * f64::from(step), &mut heard);
/// }
/// let touch = heard.touches[0];
/// assert!(sheet.contains(touch.at));
/// // Where the finger will be when waves that start now have arrived, 10 ms from now.
/// for (finger, _) in sources.fingers() {
///     assert!(sources.predict(finger, 0.998, 0.010).is_some());
/// }
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
pub struct Sources {
    surface: Outline,
    sources: Vec<Box<dyn Source>>,
    fingers: Vec<Followed>,
    given: u64,
    now: f64,
    told: f64,
    crowded: u64,
    fresh: Heard,
}

impl Sources {
    /// An empty set of sources for a surface.
    pub fn new(surface: &Outline) -> Self {
        let (sources, fingers, fresh) = (Vec::new(), Vec::with_capacity(MOST), Heard::default());
        let (now, told) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        Self { surface: surface.clone(), sources, fingers, given: 0, now, told, crowded: 0, fresh }
    }

    /// Adds a source of touches.
    pub fn push(&mut self, source: Box<dyn Source>) {
        self.sources.push(source);
    }

    /// The sources by name, with the counts of each.
    pub fn each(&self) -> impl Iterator<Item = (&str, Counts)> {
        self.sources.iter().map(|source| (source.name(), source.counts()))
    }

    /// Sums of the counts of all sources, and of the fingers refused here because 128 were down.
    pub fn counts(&self) -> Counts {
        let all = self.sources.iter().map(|source| source.counts());
        let here = Counts { crowded: self.crowded, ..Counts::default() };
        all.fold(here, |sum, counts| sum + counts)
    }

    /// Polls every source up to `now`, in s of the caller's clock, and appends what they report in order of time.
    pub fn poll(&mut self, now: f64, heard: &mut Heard) {
        self.now = self.now.max(now);
        let mut fresh = std::mem::take(&mut self.fresh);
        let before = heard.touches.len();
        for i in 0..self.sources.len() {
            self.sources[i].poll(self.now, &mut fresh);
            for touch in &fresh.touches {
                self.follow(i, *touch, heard);
            }
            heard.wishes.append(&mut fresh.wishes);
            fresh.clear();
        }
        self.fresh = fresh;
        // Stable, so that what one source reports stays in order.
        heard.touches[before..].sort_by(|a, b| a.time.total_cmp(&b.time));
        // A source that lags behind reports times before those already reported by others.
        for touch in &mut heard.touches[before..] {
            self.told = self.told.max(touch.time);
            touch.time = self.told;
        }
    }

    /// Latest time of the next poll, in s of the caller's clock, if none of the [files](Sources::files) becomes
    /// readable before; `None` for no limit.
    pub fn due(&self, now: f64) -> Option<f64> {
        self.sources.iter().filter_map(|source| source.due(now)).min_by(f64::total_cmp)
    }

    /// Files and sockets that become readable when there is something to poll for.
    #[cfg(unix)]
    pub fn files(&self) -> Vec<BorrowedFd<'_>> {
        let mut files = Vec::new();
        self.sources.iter().for_each(|source| source.files(&mut files));
        files
    }

    fn follow(&mut self, source: usize, touch: Touch, heard: &mut Heard) {
        let found = self.fingers.iter().position(|f| f.source == source && f.theirs == touch.finger);
        let ours = match (touch.phase, found) {
            (Phase::Down, None) if self.fingers.len() < MOST => {
                self.given += 1;
                let motion = Motion::new(touch.time, touch.at);
                self.fingers.push(Followed { source, theirs: touch.finger, ours: self.given, motion });
                self.given
            }
            (Phase::Down, None) => {
                self.crowded += 1;
                return;
            }
            (Phase::Up, Some(i)) => self.fingers.remove(i).ours,
            (_, Some(i)) => {
                self.fingers[i].motion.push(touch.time, touch.at);
                self.fingers[i].ours
            }
            // Its coming was dropped, so the rest of it is too.
            (_, None) => return,
        };
        heard.touches.push(Touch { finger: ours, ..touch });
    }

    /// Numbers of the fingers that are down, and the motion of each.
    pub fn fingers(&self) -> impl Iterator<Item = (u64, &Motion)> {
        self.fingers.iter().map(|finger| (finger.ours, &finger.motion))
    }

    /// Predicted place of a finger, in m, `ahead` s after `now`: at most 20 mm from its last place, and on the
    /// surface. `None` if no such finger is down.
    pub fn predict(&self, finger: u64, now: f64, ahead: f64) -> Option<Point> {
        let found = self.fingers.iter().find(|f| f.ours == finger)?;
        Some(found.motion.predict(now, ahead, REACH, &self.surface))
    }
}
