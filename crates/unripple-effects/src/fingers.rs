//! Fingers on the surface, and the effects under each.

use crate::play::{Moment, Play};
use crate::{Region, limits};
use unripple_core::{Outline, Point};

/// Time constant of the first-order low-pass filter that smooths a finger's velocity, in s. With twice this value, gains follow the speed
/// more slowly; halved, they follow the noise of the measured positions.
const SMOOTHING: f64 = 0.015;
/// Least time between two touches for which a velocity is computed, in s: a division by less would make it
/// huge.
const SHORTEST: f64 = 1e-6;

/// A finger on the surface, and every effect under it.
pub(crate) struct Finger {
    /// Number of the contact, which is part of the numbers of its voices.
    pub contact: u64,
    /// Time, position, force and velocity at its last touch event.
    pub last: Moment,
    has_moved: bool,
    /// The state of each effect under this finger; `None` for effects that a finger does not start.
    pub plays: Vec<Option<Under>>,
}

/// An effect under a finger.
pub(crate) struct Under {
    /// Whether the finger is in its region.
    pub inside: bool,
    /// The running effect, which gives the cues.
    pub play: Box<dyn Play>,
}

impl Finger {
    /// A finger that was put down at a time (s) and a place (m), with a force (N) if that is known.
    pub fn new(contact: u64, time: f64, at: Point, force: Option<f64>, plays: Vec<Option<Under>>) -> Self {
        let last = Moment { time, at, force, velocity: Point::default() };
        Self { contact, last, has_moved: false, plays }
    }

    /// The state of the finger after a touch event at a time (s), place (m) and force (N). Its velocity is the mean since the last
    /// event, smoothed.
    pub fn moved(&mut self, time: f64, at: Point, force: Option<f64>) -> Moment {
        let elapsed = time - self.last.time;
        let mut velocity = self.last.velocity;
        if elapsed >= SHORTEST {
            // After a rest, the earlier velocity is not used.
            let fresh = !self.has_moved || elapsed > limits::HOLD;
            let weight = if fresh { 1.0 } else { 1.0 - (-elapsed / SMOOTHING).exp() };
            velocity.x += weight * ((at.x - self.last.at.x) / elapsed - velocity.x);
            velocity.y += weight * ((at.y - self.last.at.y) / elapsed - velocity.y);
            self.has_moved = true;
        }
        Moment { time, at, force, velocity }
    }
}

/// Whether an effect acts at a place (m): whether the place lies in the effect's region and on the sheet.
pub(crate) fn holds(outline: &Outline, region: &Region, at: Point) -> bool {
    region.contains(at) && outline.contains(at)
}
