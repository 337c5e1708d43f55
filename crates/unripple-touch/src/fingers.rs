//! The fingers of one source that are down: their numbers, time-outs and quotas.

use crate::options::MOST_FORCE;
use crate::{Counts, Heard, Options, TouchError, Wish};
use unripple_core::{Phase, Point, Touch};

/// Fingers that may come within one poll: more are counted and dropped, so that a poll does bounded work.
const DOWNS: usize = 256;

/// Identity of a finger: its sender, and the numbers that the sender gave it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Number of the sender: an address, a connection.
    pub peer: u32,
    /// Number of one of the sender's lists of fingers, such as a TUIO profile or a slot of a touch screen. Each list
    /// numbers its fingers independently. 0 if the sender has only one.
    pub stream: u32,
    /// The sender's number for the finger, which it may use again later.
    pub session: i64,
}

/// Reason for which a finger was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// A coordinate is not finite, or a force is not from 0 to 100 N.
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
    /// Time of the last message about it, in s of the clock of time-outs ([`Fingers::begin`]).
    spoken: f64,
    /// Index of its last move among the touches of this poll.
    moved: Option<usize>,
}

/// The fingers of one source that are down. It gives each finger a number that is never used again, lifts those
/// without a message within the time-out, and refuses invalid ones. Memory is bounded for any input.
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
    /// An empty set of fingers. Fails if an option is out of range.
    pub fn new(options: Options) -> Result<Self, TouchError> {
        options.check()?;
        let live = Vec::with_capacity(options.most);
        let (now, awake, counts) = (f64::NEG_INFINITY, 0.0, Counts::default());
        Ok(Self { options, live, given: 0, now, awake, downs: 0, counts })
    }

    /// The options that the set was made with.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Counts of what was accepted and refused so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Number of fingers that are down.
    pub fn count(&self) -> usize {
        self.live.len()
    }

    /// Begins a poll at `now`, in s. Between two polls the clock of time-outs advances by at most a quarter of the
    /// time-out, so that no finger is lifted because polling paused.
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

    /// Time of the present poll, in s.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// The clock of time-outs, in s.
    pub(crate) fn awake(&self) -> f64 {
        self.awake
    }

    /// Reports a finger at a place, in m, pressing with a force, in N. A new finger comes down; a known one moves, or
    /// rests if place and force are unchanged. A place off the surface is refused, and lifts the finger if it is
    /// down.
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

    /// Reports a finger by a sensor's coordinates and pressure, each from 0 to 1. The first coordinate is from the
    /// left, the second from the top. Converts them to m by [`Options::mapping`] and to N by [`Options::full_force`],
    /// then proceeds as [`Fingers::put`].
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

    /// Whether there is room for one more finger of a sender that has `same` fingers down. If all places are taken,
    /// the sender with the most fingers loses its latest one, provided that it then still has at least as many as the
    /// other: whoever comes first must not keep all others out.
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
        self.counts.downs += u64::from(phase == Phase::Down);
    }

    /// Whether the finger with this key is down.
    pub fn has(&self, key: Key) -> bool {
        self.live.iter().any(|finger| finger.key == key)
    }

    /// Restarts the time-out of every finger whose key satisfies the rule.
    pub fn renew_where(&mut self, rule: impl Fn(&Key) -> bool) {
        let awake = self.awake;
        self.live.iter_mut().filter(|finger| rule(&finger.key)).for_each(|finger| finger.spoken = awake);
    }

    /// Lifts the finger with this key; returns whether it was down.
    pub fn lift(&mut self, key: Key, heard: &mut Heard) -> bool {
        self.lift_where(|other| *other == key, heard) > 0
    }

    /// Lifts every finger whose key satisfies the rule; returns their number.
    pub fn lift_where(&mut self, rule: impl Fn(&Key) -> bool, heard: &mut Heard) -> usize {
        self.leave(|finger| rule(&finger.key), heard)
    }

    /// Lifts every finger without a message within the time-out. To be called at the end of a poll, after all
    /// [`Fingers::put`].
    pub fn expire(&mut self, heard: &mut Heard) {
        let oldest = self.awake - self.options.timeout;
        let gone = self.leave(|finger| finger.spoken < oldest, heard);
        self.counts.expired += gone as u64;
    }

    /// Time at which time-outs must be checked again, in s, given the present time in s; none while no finger is
    /// down. The clock of time-outs advances by at most a quarter of the time-out from poll to poll.
    pub(crate) fn due(&self, now: f64) -> Option<f64> {
        (!self.live.is_empty()).then_some(now + self.options.timeout / 8.0)
    }

    /// Hands a request on, if there is room.
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
