//! The fingers that are down: which of them each sender speaks of, how long they are silent, how many there may be.

use crate::options::MOST_FORCE;
use crate::{Counts, Heard, Options, TouchError, Wish};
use unripple_core::{Phase, Point, Touch};

/// Fingers that may come within one poll: more are counted and dropped, so that a poll does bounded work.
const DOWNS: usize = 256;

/// Identity of a finger, by its sender's own numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Number of the sender: an address, a connection.
    pub peer: u32,
    /// Number of the sender's list of fingers.
    pub stream: u32,
    /// The sender's number for the finger, which it may use again later.
    pub session: i64,
}

/// Reason for which a finger was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// A coordinate or a force is no number, or an impossible one.
    #[error("expected finite coordinates and a force from 0 to 100 N")]
    Number,
    /// The place is not on the surface.
    #[error("expected a place on the surface")]
    Outside,
    /// There are too many fingers already.
    #[error("expected fewer fingers at once")]
    Crowded,
}

#[derive(Clone, Copy, Debug)]
struct Live {
    key: Key,
    finger: u64,
    at: Point,
    force: Option<f64>,
    /// When it was last spoken of, by the clock that stands still while nobody polls.
    spoken: f64,
    /// Its last move among the touches of this poll.
    moved: Option<usize>,
}

/// The fingers that a source knows of: gives them numbers that are never used again, lifts those nobody speaks of any
/// more, refuses impossible ones. Memory is bounded whatever comes.
///
/// ```
/// use unripple_core::{Outline, Phase, Point, Shape};
/// use unripple_touch::{Fingers, Heard, Key, Options};
///
/// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
/// let (mut fingers, mut heard) = (Fingers::new(Options::new(&sheet))?, Heard::default());
/// let key = Key { peer: 0, stream: 0, session: 7 };
/// fingers.begin(0.0);
/// fingers.put(key, Point::from_mm(62.0, 90.0), None, &mut heard).unwrap();
/// for i in 1..30 {
///     fingers.begin(0.1 * f64::from(i));
///     fingers.expire(&mut heard);
/// }
/// let phases: Vec<Phase> = heard.touches.iter().map(|touch| touch.phase).collect();
/// assert_eq!(phases, [Phase::Down, Phase::Up]);
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Fingers {
    options: Options,
    live: Vec<Live>,
    given: u64,
    now: f64,
    awake: f64,
    downs: usize,
    pub(crate) counts: Counts,
}

impl Fingers {
    /// No finger yet.
    pub fn new(options: Options) -> Result<Self, TouchError> {
        options.check()?;
        let live = Vec::with_capacity(options.most);
        let (now, awake, counts) = (f64::NEG_INFINITY, 0.0, Counts::default());
        Ok(Self { options, live, given: 0, now, awake, downs: 0, counts })
    }

    /// The options that it was made with.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Numbers of what was taken in and what was refused.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Number of fingers that are down.
    pub fn count(&self) -> usize {
        self.live.len()
    }

    /// A poll begins, at `now` in s. The clock of time-outs stands still while nobody polls.
    pub fn begin(&mut self, now: f64) {
        if now > self.now {
            if self.now.is_finite() {
                self.awake += (now - self.now).min(self.options.timeout / 4.0);
            }
            self.now = now;
        }
        self.downs = 0;
        self.live.iter_mut().for_each(|finger| finger.moved = None);
    }

    /// The time of the poll, in s.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// The clock of time-outs, in s.
    pub(crate) fn awake(&self) -> f64 {
        self.awake
    }

    /// A finger is at a place in m, pressing with a force in N: it comes, moves or only goes on. One that slides off the
    /// surface leaves.
    pub fn put(&mut self, key: Key, at: Point, force: Option<f64>, heard: &mut Heard) -> Result<(), Refusal> {
        if !at.is_finite() || force.is_some_and(|f| !(0.0..=MOST_FORCE).contains(&f)) {
            self.counts.numbers += 1;
            return Err(Refusal::Number);
        }
        if !self.options.surface.contains(at) {
            return Err(self.off(key, heard));
        }
        match self.live.iter().position(|finger| finger.key == key) {
            Some(i) => self.go_on(i, at, force, heard),
            None => self.come(key, at, force, heard)?,
        }
        Ok(())
    }

    /// The same for a sensor's coordinates and pressure, each from 0 to 1, the second coordinate from the top.
    pub fn put_sensed(
        &mut self,
        key: Key,
        place: (f64, f64),
        pressure: Option<f64>,
        heard: &mut Heard,
    ) -> Result<(), Refusal> {
        if !place.0.is_finite() || !place.1.is_finite() || pressure.is_some_and(|p| !p.is_finite()) {
            self.counts.numbers += 1;
            return Err(Refusal::Number);
        }
        let Some(at) = self.options.mapping.point(place.0, place.1) else {
            return Err(self.off(key, heard));
        };
        let force = pressure.zip(self.options.full_force).map(|(p, full)| p.clamp(0.0, 1.0) * full);
        self.put(key, at, force, heard)
    }

    fn off(&mut self, key: Key, heard: &mut Heard) -> Refusal {
        self.counts.outside += 1;
        self.lift(key, heard);
        Refusal::Outside
    }

    fn come(&mut self, key: Key, at: Point, force: Option<f64>, heard: &mut Heard) -> Result<(), Refusal> {
        let same = self.live.iter().filter(|finger| finger.key.peer == key.peer).count();
        let taken = same >= self.options.most_per_sender || self.downs >= DOWNS;
        if taken || !self.make_room(same, heard) {
            self.counts.crowded += 1;
            return Err(Refusal::Crowded);
        }
        (self.given, self.downs) = (self.given + 1, self.downs + 1);
        let live = Live { key, finger: self.given, at, force, spoken: self.awake, moved: None };
        self.tell(live, Phase::Down, heard);
        self.live.push(live);
        Ok(())
    }

    /// Whether there is room for one more finger of a sender that has so many. Where all places are taken, the sender with most of them
    /// gives up its latest if it still has no fewer than the other then: whoever comes first does not keep everybody else out.
    fn make_room(&mut self, same: usize, heard: &mut Heard) -> bool {
        if self.live.len() < self.options.most {
            return true;
        }
        // Senders are few, while fingers may be a thousand.
        let mut senders: Vec<(u32, usize)> = Vec::new();
        for finger in &self.live {
            match senders.iter_mut().find(|(peer, _)| *peer == finger.key.peer) {
                Some((_, held)) => *held += 1,
                None => senders.push((finger.key.peer, 1)),
            }
        }
        let (largest, most) = senders.into_iter().max_by_key(|(_, held)| *held).unwrap_or_default();
        let latest = self.live.iter().rposition(|finger| finger.key.peer == largest);
        match latest.filter(|_| most > same + 1) {
            Some(latest) => {
                let finger = self.live.remove(latest);
                self.tell(finger, Phase::Up, heard);
                true
            }
            None => false,
        }
    }

    fn go_on(&mut self, i: usize, at: Point, force: Option<f64>, heard: &mut Heard) {
        let finger = &mut self.live[i];
        finger.spoken = self.awake;
        if finger.at == at && finger.force == force {
            return;
        }
        (finger.at, finger.force) = (at, force);
        // Only the last place within a poll is worth reporting.
        if let Some(told) = finger.moved.and_then(|at| heard.touches.get_mut(at)) {
            (told.at, told.force) = (at, force);
            return;
        }
        finger.moved = Some(heard.touches.len());
        let finger = *finger;
        self.tell(finger, Phase::Move, heard);
    }

    fn tell(&mut self, live: Live, phase: Phase, heard: &mut Heard) {
        let Live { finger, at, force, .. } = live;
        heard.touches.push(Touch { finger, phase, at, time: self.now, force });
        self.counts.touches += 1;
    }

    /// Whether there is such a finger.
    pub fn has(&self, key: Key) -> bool {
        self.live.iter().any(|finger| finger.key == key)
    }

    /// Every finger that a rule holds for is still there.
    pub fn renew_where(&mut self, rule: impl Fn(&Key) -> bool) {
        let awake = self.awake;
        self.live.iter_mut().filter(|finger| rule(&finger.key)).for_each(|finger| finger.spoken = awake);
    }

    /// Whether there was such a finger; if so, it leaves.
    pub fn lift(&mut self, key: Key, heard: &mut Heard) -> bool {
        self.lift_where(|other| *other == key, heard) > 0
    }

    /// Every finger that a rule holds for leaves; returns their number.
    pub fn lift_where(&mut self, rule: impl Fn(&Key) -> bool, heard: &mut Heard) -> usize {
        self.leave(|finger| rule(&finger.key), heard)
    }

    /// Lifts whatever nobody spoke of within the time-out; to be called when all that came was put.
    pub fn expire(&mut self, heard: &mut Heard) {
        let oldest = self.awake - self.options.timeout;
        let gone = self.leave(|finger| finger.spoken < oldest, heard);
        self.counts.expired += gone as u64;
    }

    /// When time-outs are to be looked at again, given the time in s: their clock goes on by a quarter of one at most from poll
    /// to poll.
    pub(crate) fn due(&self, now: f64) -> Option<f64> {
        (!self.live.is_empty()).then_some(now + self.options.timeout / 8.0)
    }

    /// Hands a wish on, if there is room.
    pub(crate) fn take_wish(&mut self, wish: Wish, heard: &mut Heard) {
        match heard.wish(wish) {
            true => self.counts.wishes += 1,
            false => self.counts.crowded += 1,
        }
    }

    fn leave(&mut self, rule: impl Fn(&Live) -> bool, heard: &mut Heard) -> usize {
        let before = self.live.len();
        let mut i = 0;
        while i < self.live.len() {
            if rule(&self.live[i]) {
                let finger = self.live.remove(i);
                self.tell(finger, Phase::Up, heard);
            } else {
                i += 1;
            }
        }
        before - self.live.len()
    }
}
