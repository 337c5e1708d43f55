//! Touches that a program pushes, at times of its own choice.

use crate::options::MOST_FORCE;
use crate::{Counts, Heard, Source, TouchError};
use std::collections::{BTreeMap, VecDeque};
use std::fmt::Display;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use unripple_core::{Outline, Phase, Point, Touch};

/// Touches that may wait for their time: ten fingers that move a hundred times a second, for a minute. Twice as many
/// take twice the memory.
const MOST_WAITING: usize = 1 << 16;

/// Fingers that may be down at once: as many as [`Sources`](crate::Sources) follow.
const MOST_DOWN: usize = 128;

/// Largest number of touches that are reported in one poll, so that a poll does bounded work.
const MOST: usize = 1024;

/// Makes a source of touches that a program pushes onto a surface, and the handle that pushes them.
///
/// ```
/// use unripple_core::{Outline, Phase, Point, Shape, Touch};
/// use unripple_touch::{Heard, Source, pushed};
///
/// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
/// let (pusher, mut source) = pushed(&sheet);
/// let down = Touch { finger: 7, phase: Phase::Down, at: Point::from_mm(62.0, 90.0), time: 0.5, force: None };
/// pusher.push(down)?;
/// pusher.push(Touch { phase: Phase::Up, time: 0.6, ..down })?;
/// assert!(pusher.push(Touch { at: Point::from_mm(62.0, 110.0), time: 0.7, ..down }).is_err());
/// let mut heard = Heard::default();
/// source.poll(0.55, &mut heard);
/// assert_eq!((heard.touches.len(), heard.touches[0].time), (1, 0.5));
/// source.poll(1.0, &mut heard);
/// assert_eq!(heard.touches[1].phase, Phase::Up);
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
pub fn pushed(surface: &Outline) -> (Pusher, Pushed) {
    let queue = Queue {
        waiting: VecDeque::new(),
        down: BTreeMap::new(),
        given: 0,
        now: f64::NEG_INFINITY,
        counts: Counts::default(),
    };
    let queue = Arc::new(Mutex::new(queue));
    (Pusher { surface: surface.clone(), queue: queue.clone() }, Pushed { queue })
}

/// The handle by which a program pushes touches to its source, from any thread.
#[derive(Clone, Debug)]
pub struct Pusher {
    surface: Outline,
    queue: Arc<Mutex<Queue>>,
}

/// A source of the touches that a [`Pusher`] pushes: each is reported by the first poll at its time or later, all in
/// order of time.
#[derive(Debug)]
pub struct Pushed {
    queue: Arc<Mutex<Queue>>,
}

/// Touches that wait for their time.
#[derive(Debug)]
struct Queue {
    /// In order of time; those of one time in the order in which they were pushed.
    waiting: VecDeque<Touch>,
    /// The last touch pushed of each finger that is down, by the program's number for it.
    down: BTreeMap<u64, Touch>,
    /// Numbers of contacts given so far.
    given: u64,
    /// Time of the last poll, in s.
    now: f64,
    counts: Counts,
}

impl Pusher {
    /// Pushes a touch. Its time is in s of the clock by which the source is polled; a time that has passed
    /// is replaced by that of the last poll. The program numbers its fingers as it likes, and may use a
    /// number again once it has lifted the finger. A finger is lifted at its last place.
    ///
    /// # Errors
    /// [`TouchError::Pushed`] for a finger that comes twice, or moves or leaves without having come; for a place that is
    /// not on the surface, a force that is not from 0 to 100 N, a time that is not finite or before that of the finger's
    /// last touch; where 128 fingers are down or 65536 touches wait. Nothing is pushed then.
    pub fn push(&self, touch: Touch) -> Result<(), TouchError> {
        let mut queue = lock(&self.queue);
        queue.counts.packets += 1;
        queue.push(touch, &self.surface)
    }
}

impl Queue {
    fn push(&mut self, touch: Touch, surface: &Outline) -> Result<(), TouchError> {
        let Touch { finger, phase, force, .. } = touch;
        let last = self.down.get(&finger).copied();
        let counts = &mut self.counts;
        match (phase, last) {
            (Phase::Down, Some(_)) => {
                return refuse(&mut counts.unknown, "finger", "one that is not down", finger);
            }
            (Phase::Move | Phase::Up, None) => {
                return refuse(&mut counts.unknown, "finger", "one that is down", finger);
            }
            _ => {}
        }
        let at = last.filter(|_| phase == Phase::Up).map_or(touch.at, |last| last.at);
        check_place(at, surface, counts)?;
        if let Some(force) = force.filter(|force| !(0.0..=MOST_FORCE).contains(force)) {
            return refuse(&mut counts.numbers, "force_n", format!("0 to {MOST_FORCE} N"), force);
        }
        if !touch.time.is_finite() {
            return refuse(&mut counts.numbers, "time_s", "a finite number", touch.time);
        }
        let time = touch.time.max(self.now);
        if let Some(last) = last.filter(|last| time < last.time) {
            let expected = format!("{} or later, the time of the finger's last touch", last.time);
            return refuse(&mut counts.late, "time_s", expected, time);
        }
        if self.waiting.len() >= MOST_WAITING {
            let expected = format!("at most {MOST_WAITING} that wait for their time");
            return refuse(&mut counts.crowded, "touches", expected, "one more");
        }
        if phase == Phase::Down && self.down.len() >= MOST_DOWN {
            let expected = format!("at most {MOST_DOWN} at once");
            return refuse(&mut counts.crowded, "fingers", expected, "one more");
        }
        let contact = last.map_or(self.given + 1, |last| last.finger);
        self.given = self.given.max(contact);
        let touch = Touch { finger: contact, phase, at, time, force };
        match phase {
            Phase::Up => self.down.remove(&finger),
            Phase::Down | Phase::Move => self.down.insert(finger, touch),
        };
        let after = self.waiting.partition_point(|other| other.time <= time);
        self.waiting.insert(after, touch);
        Ok(())
    }
}

/// Refuses a place that is not on the surface.
fn check_place(at: Point, surface: &Outline, counts: &mut Counts) -> Result<(), TouchError> {
    if !at.is_finite() {
        return refuse(&mut counts.numbers, "at_m", "finite coordinates", format!("({}, {})", at.x, at.y));
    }
    if !surface.contains(at) {
        let found = format!("{at}; nearest is {}", surface.nearest(at));
        return refuse(&mut counts.outside, "at_m", "a place on the surface", found);
    }
    Ok(())
}

/// Counts a refusal, and makes the error of it.
fn refuse(
    count: &mut u64,
    what: &'static str,
    expected: impl Into<String>,
    found: impl Display,
) -> Result<(), TouchError> {
    *count += 1;
    Err(TouchError::Pushed { what, expected: expected.into(), found: found.to_string() })
}

/// The queue behind its lock, even if another thread panicked while it held it.
fn lock(queue: &Mutex<Queue>) -> MutexGuard<'_, Queue> {
    queue.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Source for Pushed {
    fn name(&self) -> &str {
        "the program"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        let mut queue = lock(&self.queue);
        queue.now = queue.now.max(now);
        let due = queue.waiting.partition_point(|touch| touch.time <= now).min(MOST);
        let downs = queue.waiting.iter().take(due).filter(|touch| touch.phase == Phase::Down).count();
        queue.counts.touches += due as u64;
        queue.counts.downs += downs as u64;
        heard.touches.extend(queue.waiting.drain(..due));
    }

    fn counts(&self) -> Counts {
        lock(&self.queue).counts
    }
}
