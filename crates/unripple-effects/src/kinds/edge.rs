//! An edge: a pulse where the finger crosses a line.

use crate::error::{place, within};
use crate::play::{Maker, Moment, Out, Play};
use crate::region::{crossing, lerp};
use crate::{EffectsError, Region, limits};
use unripple_core::Point;

/// How far a finger goes from where it crossed before another crossing counts, in m: a finger that trembles
/// on the line is felt once. Doubled, it has to go 2 mm away to feel the line again.
const AWAY: f64 = 1e-3;

/// A pulse where the finger crosses a line, or the border of its region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The line; without, the border of the region.
    pub line: Option<Line>,
}

/// A straight line from one point to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end, in m.
    pub from: Point,
    /// The other end, in m.
    pub to: Point,
}

impl Edge {
    /// Refuses a line that is not on any surface.
    pub(super) fn check(&self) -> Result<(), EffectsError> {
        let Some(line) = self.line else { return Ok(()) };
        place("end of a line", line.from)?;
        place("end of a line", line.to)?;
        within("length of a line", line.from.distance(line.to), [limits::LENGTH[0], 4.0 * limits::LENGTH[1]])
    }

    /// What plays it under a finger, the effect's region being the border without a line.
    pub(super) fn maker(&self, region: Region) -> Maker {
        let line = self.line;
        Box::new(move |_| Box::new(Crossing { line, region: region.clone(), last: None }))
    }
}

struct Crossing {
    line: Option<Line>,
    region: Region,
    /// Where the finger last crossed, until it is away from there.
    last: Option<Point>,
}

impl Play for Crossing {
    fn pass(&mut self, from: &Moment, to: &Moment, out: &mut Out) {
        let shares = match self.line {
            // A line counts where the region holds.
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
