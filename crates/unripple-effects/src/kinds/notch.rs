//! Notches: equally spaced detents along an axis.

use crate::error::{place, within};
use crate::play::{Maker, Moment, Out, Play};
use crate::region::lerp;
use crate::{EffectsError, limits};
use unripple_core::Point;

/// Equally spaced detents along an axis, like the marks of a ruler: a pulse whenever the finger enters the next detent.
///
/// The centres of detents lie at whole multiples of the pitch from the origin. The finger enters the next
/// detent when it is past the midpoint between the two detents by the hysteresis, so that a finger that
/// trembles there does not set off repeated pulses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Notch {
    /// Distance between detents, in m.
    pub pitch: f64,
    /// Direction of the axis, in rad anticlockwise from x.
    pub axis: f64,
    /// The centre of one of the detents, in m.
    pub origin: Point,
    /// Distance beyond the midpoint between two detents at which the next one is entered, as a share of the pitch.
    pub hysteresis: f64,
}

impl Notch {
    /// Refuses a pitch, axis, origin or hysteresis that is out of range.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        within("pitch of notches", self.pitch, limits::PITCH)?;
        within("axis of notches", self.axis, limits::ANGLE)?;
        within("hysteresis of notches", self.hysteresis, limits::HYSTERESIS)?;
        place("origin of notches", self.origin)
    }

    /// The function that starts it under a finger.
    pub(super) fn maker(&self) -> Maker {
        let notch = *self;
        Box::new(move |_| Box::new(Sliding { notch, on: 0.0 }))
    }

    /// Distance of a place from the origin along the axis, in pitches.
    fn along(&self, p: Point) -> f64 {
        let (sin, cos) = self.axis.sin_cos();
        ((p.x - self.origin.x) * cos + (p.y - self.origin.y) * sin) / self.pitch
    }
}

struct Sliding {
    notch: Notch,
    /// Number of the detent that the finger is in, counted from the origin.
    on: f64,
}

impl Play for Sliding {
    fn enter(&mut self, now: &Moment, _touched: bool, _out: &mut Out) {
        self.on = self.notch.along(now.at).round();
    }

    fn step(&mut self, from: &Moment, to: &Moment, out: &mut Out) {
        let (start, end) = (self.notch.along(from.at), self.notch.along(to.at));
        let reach = 0.5 + self.notch.hysteresis;
        for _ in 0..limits::MOST_IN_STEP {
            let way = if end > self.on + reach {
                1.0
            } else if end < self.on - reach {
                -1.0
            } else {
                return;
            };
            let share = ((self.on + way * reach - start) / (end - start)).clamp(0.0, 1.0);
            self.on += way;
            out.pulse(from.time + share * (to.time - from.time), lerp(from.at, to.at, share), 1.0);
        }
        self.on = end.round();
    }
}
