//! Shape: a path drawn repeatedly on a resting finger or palm.

use crate::error::{counted, place, within};
use crate::play::{Beat, Maker, Moment, Out, Play};
use crate::region::lerp;
use crate::{EffectsError, limits};
use std::sync::Arc;
use unripple_core::Point;

/// A shape: a path of straight lines that pulses draw on a resting finger or palm, again and again while the finger is in the region.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// The corners of the path, in m from the anchor.
    pub path: Vec<Point>,
    /// Whether the last corner is joined to the first.
    pub closed: bool,
    /// The origin of the corners' coordinates.
    pub anchor: Anchor,
    /// How the path is drawn: by a moving point, or on all points at once.
    pub trace: Trace,
    /// Pulses per second.
    pub rate: f64,
}

/// The origin of the coordinates of a shape's corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The place where the finger entered the region; the shape stays there when the finger moves.
    Finger,
    /// The origin of the surface, the lower-left corner of its bounding box.
    Surface,
}

/// How a shape is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trace {
    /// Each pulse is focused on a point that moves along the path at this speed in m/s, and continues from
    /// the end of the path at its start.
    Moving(f64),
    /// Each pulse is focused on many points along the path at the same instant; neighbouring points are at
    /// most this far apart, in m.
    AtOnce(f64),
}

impl Traced {
    /// Checks all parameters, and the length of the path, against [`limits`].
    ///
    /// # Errors
    /// The error of the first value that is out of range.
    pub fn check(&self) -> Result<(), EffectsError> {
        counted("corners of a shape", self.path.len(), 2, limits::MOST_CORNERS)?;
        self.path.iter().try_for_each(|corner| place("corner of a shape", *corner))?;
        within("rate of a shape", self.rate, limits::RATE)?;
        let length = self.length();
        within("length of a shape", length, limits::LENGTH)?;
        match self.trace {
            Trace::Moving(speed) => within("speed of a shape", speed, limits::SPEED),
            Trace::AtOnce(spacing) => {
                within("spacing of a shape", spacing, limits::PITCH)?;
                let points = (length / spacing) as usize + self.path.len();
                counted("points of a shape at once", points, 2, limits::MOST_AT_ONCE)
            }
        }
    }

    /// Corners in order, the first again at the end of a closed shape.
    fn corners(&self) -> impl Iterator<Item = Point> + '_ {
        self.path.iter().chain(self.path.first().filter(|_| self.closed)).copied()
    }

    fn sides(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        self.corners().zip(self.corners().skip(1))
    }

    fn length(&self) -> f64 {
        self.sides().map(|(a, b)| a.distance(b)).sum()
    }

    /// The point at a distance (m) along the path, which starts again at its end.
    fn along(&self, distance: f64, length: f64) -> Point {
        let mut left = distance.rem_euclid(length);
        for (a, b) in self.sides() {
            let side = a.distance(b);
            if left < side {
                return lerp(a, b, left / side);
            }
            left -= side;
        }
        self.corners().last().unwrap_or_default()
    }

    /// Points on all sides, evenly on each, at most `spacing` (m) apart.
    fn points(&self, spacing: f64) -> Vec<Point> {
        let cut = |(a, b): (Point, Point)| {
            let pieces = (a.distance(b) / spacing).ceil().max(1.0);
            (0..pieces as usize).map(move |i| lerp(a, b, i as f64 / pieces))
        };
        let end = self.corners().last().filter(|_| !self.closed);
        self.sides().flat_map(cut).chain(end).collect()
    }

    /// The function that starts it under a finger.
    pub(super) fn maker(&self) -> Maker {
        let shape = Arc::new(self.clone());
        Box::new(move |_| Box::new(Drawing { shape: shape.clone(), on: None }))
    }
}

struct Drawing {
    shape: Arc<Traced>,
    on: Option<On>,
}

/// A shape being drawn, with its place on the surface.
struct On {
    origin: Point,
    length: f64,
    beat: Beat,
    points: Arc<[Point]>,
}

impl Play for Drawing {
    fn enter(&mut self, now: &Moment, _touched: bool, out: &mut Out) {
        let origin = match self.shape.anchor {
            Anchor::Finger => now.at,
            Anchor::Surface => Point::default(),
        };
        let moved = |p: Point| Point::new(origin.x + p.x, origin.y + p.y);
        let points: Arc<[Point]> = match self.shape.trace {
            Trace::Moving(_) => Arc::new([]),
            Trace::AtOnce(spacing) => {
                let points = self.shape.points(spacing).into_iter().map(moved);
                points.filter(|p| out.outline.contains(*p)).collect()
            }
        };
        let beat = Beat::new(now.time, 1.0 / self.shape.rate);
        self.on = Some(On { origin, length: self.shape.length(), beat, points });
    }

    fn leave(&mut self, now: &Moment, out: &mut Out) {
        if self.on.take().is_some() {
            out.stop(0, now.time, 0.0);
        }
    }

    fn due(&mut self, until: f64, out: &mut Out) {
        let Some(on) = &mut self.on else { return };
        while !out.is_full() {
            let Some((index, time)) = on.beat.next(until) else { break };
            match self.shape.trace {
                Trace::Moving(speed) => {
                    let p = self.shape.along(speed * index as f64 / self.shape.rate, on.length);
                    out.pulse(time, Point::new(on.origin.x + p.x, on.origin.y + p.y), 1.0);
                }
                Trace::AtOnce(_) if on.points.is_empty() => {}
                Trace::AtOnce(_) => out.shape(time, on.points.clone()),
            }
        }
    }
}
