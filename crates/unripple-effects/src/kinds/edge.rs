//! An edge: a pulse where the finger crosses a line.

use crate::error::{place, within};
use crate::play::{Maker, Moment, Out, Play};
use crate::region::{crossing, lerp};
use crate::{EffectsError, Region, limits};
use unripple_core::Point;

/// Distance that a finger has to move away from a crossing before another crossing counts, in m, so that a finger that
/// trembles on the line sets off one pulse only. With twice this distance, it has to move 2 mm away to feel the line again.
const AWAY: f64 = 1e-3;

/// An edge: a pulse where the finger crosses a line, or the border of the effect's region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The line, felt where it lies in the region; `None` for the border of the region.
    pub line: Option<Line>,
}

/// A straight line between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end, in m.
    pub from: Point,
    /// The other end, in m.
    pub to: Point,
}

impl Edge {
    /// Refuses a line whose ends or length are out of range.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        let Some(line) = self.line else { return Ok(()) };
        place("end of a line", line.from)?;
        place("end of a line", line.to)?;
        within("length of a line", line.from.distance(line.to), [limits::LENGTH[0], 4.0 * limits::LENGTH[1]])
    }

    /// The function that starts it under a finger, given the effect's region.
    pub(super) fn maker(&self, region: Region) -> Maker {
        let line = self.line;
        Box::new(move |_| Box::new(Crossing { line, region: region.clone(), last: None }))
    }
}

struct Crossing {
    line: Option<Line>,
    region: Region,
    /// Where the finger last crossed, until it has moved away by more than [`AWAY`].
    last: Option<Point>,
}

impl Play for Crossing {
    fn pass(&mut self, from: &Moment, to: &Moment, out: &mut Out) {
        let shares = match self.line {
            // A crossing of a line counts only within the region.
            Some(line) => {
                let met = crossing((line.from, line.to), from.at, to.at);
                met.into_iter().filter(|s| self.region.contains(lerp(from.at, to.at, *s))).collect()
            }
            None => self.region.crossings(from.at, to.at),
        };
        for share in shares.into_iter().take(limits::MOST_IN_STEP) {
            let at = lerp(from.at, to.at, share);
            if self.last.is_none_or(|last| last.distance(at) > AWAY) {
                out.pulse(from.time + share * (to.time - from.time), at, 1.0);
                self.last = Some(at);
            }
        }
        if self.last.is_some_and(|last| last.distance(to.at) > AWAY) {
            self.last = None;
        }
    }
}
