//! Fingers on the surface, and the effects under each.

use crate::play::{Moment, Play};
use crate::{Region, limits};
use unripple_core::{Outline, Point};

/// Time constant over which a finger's velocity is smoothed, in s: a first-order low-pass filter. Doubled,
/// gains follow the speed later; halved, they follow the noise of places.
const SMOOTHING: f64 = 0.015;
/// Touches closer in time than this say nothing of the velocity, in s: a division by so little would make it
/// huge.
const SHORTEST: f64 = 1e-6;

/// A finger on the surface, and every effect under it.
pub(crate) struct Finger {
    /// Number of the contact, from which its voices are numbered.
    pub contact: u64,
    /// When and where it was last heard of.
    pub last: Moment,
    has_moved: bool,
    /// The play of each effect that fingers set off, and whether the finger is in its region.
    pub plays: Vec<Option<Under>>,
}

/// An effect under a finger.
pub(crate) struct Under {
    /// Whether the finger is in its region.
    pub inside: bool,
    /// What it plays.
    pub play: Box<dyn Play>,
}

impl Finger {
    /// A finger that came at a time (s) and a place (m), with a force (N) if that is known.
    pub fn new(contact: u64, time: f64, at: Point, force: Option<f64>, plays: Vec<Option<Under>>) -> Self {
        let last = Moment { time, at, force, velocity: Point::default() };
        Self { contact, last, has_moved: false, plays }
    }

    /// What a touch at a time (s), place (m) and force (N) makes of the finger: its velocity is that since
    /// the last touch, smoothed.
    pub fn moved(&mut self, time: f64, at: Point, force: Option<f64>) -> Moment {
        let elapsed = time - self.last.time;
        let mut velocity = self.last.velocity;
        if elapsed >= SHORTEST {
            // After a rest, what was before says nothing.
            let fresh = !self.has_moved || elapsed > limits::HOLD;
            let weight = if fresh { 1.0 } else { 1.0 - (-elapsed / SMOOTHING).exp() };
            velocity.x += weight * ((at.x - self.last.at.x) / elapsed - velocity.x);
            velocity.y += weight * ((at.y - self.last.at.y) / elapsed - velocity.y);
            self.has_moved = true;
        }
        Moment { time, at, force, velocity }
    }
}

/// Whether a place (m) is one where an effect holds: in its region, and on the sheet.
pub(crate) fn holds(outline: &Outline, region: &Region, at: Point) -> bool {
    region.contains(at) && outline.contains(at)
}
