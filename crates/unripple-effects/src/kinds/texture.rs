//! Texture: pulses along the finger's path, at a rate in proportion to its speed.

use crate::error::within;
use crate::play::{Maker, Moment, Out, Play};
use crate::region::lerp;
use crate::{Curve, EffectsError, limits};
use unripple_core::{Point, Random};

/// A texture: pulses ("grains") spaced along the finger's path, so that the rate of pulses is proportional
/// to the finger's speed.
///
/// Between two touch events the finger is assumed to keep its velocity, for at most 50 ms ([`limits::HOLD`]), so that pulses come
/// evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Mean distance between pulses, in m.
    pub pitch: f64,
    /// Random variation, 0 to 1: each distance between pulses differs from the mean by up to this share, and
    /// gains are reduced by up to this share.
    pub grain: f64,
    /// Seed of the random variation: the same seed and touches give the same pulses.
    pub seed: u64,
    /// Gain (0 to 1) as a function of the finger's speed in m/s.
    pub speed_gain: Curve,
}

impl Texture {
    /// Refuses a pitch or grain that is out of range.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        within("pitch of a texture", self.pitch, limits::PITCH)?;
        within("grain of a texture", self.grain, limits::SHARE)
    }

    /// The function that starts it under a finger.
    pub(super) fn maker(&self) -> Maker {
        let texture = self.clone();
        Box::new(move |contact| {
            let random = Random::seeded(texture.seed ^ contact.rotate_left(32));
            Box::new(Rubbing { texture: texture.clone(), random, travelled: 0.0, next: 0.0, last: None })
        })
    }
}

struct Rubbing {
    texture: Texture,
    random: Random,
    /// Length of the path up to the last touch event, in m.
    travelled: f64,
    /// Length of the path at which the next grain lies, in m.
    next: f64,
    last: Option<Moment>,
}

impl Rubbing {
    /// Distance from the next grain to the one after it (m), long enough at this speed (m/s) for the rate to stay within its limit.
    fn spacing(&mut self, speed: f64) -> f64 {
        let varied = 1.0 + self.texture.grain * self.random.between(-1.0, 1.0);
        (self.texture.pitch * varied).max(speed / limits::RATE[1]).max(limits::PITCH[0])
    }

    fn grain(&mut self, at: f64, place: Point, speed: f64, out: &mut Out) {
        let gain = self.texture.speed_gain.at(speed) * (1.0 - self.texture.grain * self.random.uniform());
        out.pulse(at, place, gain);
        self.next += self.spacing(speed);
    }
}

impl Play for Rubbing {
    fn enter(&mut self, now: &Moment, _touched: bool, _out: &mut Out) {
        self.last = Some(*now);
        self.travelled = 0.0;
        self.next = self.spacing(0.0);
    }

    fn step(&mut self, from: &Moment, to: &Moment, out: &mut Out) {
        let length = from.at.distance(to.at);
        let (start, end) = (self.travelled, self.travelled + length);
        let speed = to.speed_at(to.time);
        for _ in 0..limits::MOST_IN_STEP {
            if self.next > end {
                break;
            }
            let share = if length > 0.0 { ((self.next - start) / length).clamp(0.0, 1.0) } else { 1.0 };
            let at = from.time + share * (to.time - from.time);
            self.grain(at, lerp(from.at, to.at, share), speed, out);
        }
        if self.next <= end {
            self.next = end + self.spacing(speed);
        }
        self.travelled = end;
        self.last = Some(*to);
    }

    fn leave(&mut self, now: &Moment, out: &mut Out) {
        // This also cancels grains that were cued ahead.
        if self.last.take().is_some() {
            out.stop(0, now.time, 0.0);
        }
    }

    fn due(&mut self, until: f64, out: &mut Out) {
        let Some(last) = self.last else { return };
        let speed = last.speed_at(last.time);
        if speed <= 0.0 {
            return;
        }
        let horizon = until.min(last.time + limits::HOLD);
        for _ in 0..limits::MOST_IN_STEP {
            let ahead = (self.next - self.travelled) / speed;
            if last.time + ahead > horizon {
                break;
            }
            let on = Point::new(last.at.x + ahead * last.velocity.x, last.at.y + ahead * last.velocity.y);
            let place = if out.outline.contains(on) { on } else { last.at };
            self.grain(last.time + ahead, place, speed, out);
        }
    }
}
