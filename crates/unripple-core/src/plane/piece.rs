//! Sides cut into short pieces, with bounds on the deviation of each from its chord.

use super::tree::Bounds;
use super::vector::{angle, cross, from_segment, minus, norm};
use crate::side::gauss;
use crate::{Point, Side};
use std::f64::consts::PI;

/// Greatest turn of the tangent along a piece, in radians: a circle has 63 pieces. With twice this value,
/// there would be half as many, each with four times the distance between curve and chord, and the search
/// for crossings would halve them again where they come near each other.
const TURN: f64 = 0.1;
/// Number of halvings after which a cubic is cut no further, since it must have a cusp there. One more halving would
/// double only the pieces at a cusp.
const DEEPEST: u32 = 24;

/// A short piece of a side, which lies within the distance `sagitta` of its chord.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Index of the side from which the piece was cut, counted over all rims.
    pub side: usize,
    /// Curve parameters of the side at the start and the end of the piece, each 0 to 1.
    pub span: [f64; 2],
    /// Start and end points, in metres.
    pub ends: [Point; 2],
    /// Upper bound of the distance between curve and chord, in metres.
    pub sagitta: f64,
    /// Upper bound of the angle by which the tangent turns along the piece, in radians.
    pub turn: f64,
}

impl Piece {
    /// The piece of a side between two parameters (0 to 1); `index` is the index of the side, counted over all rims.
    pub fn new(side: &Side, index: usize, span: [f64; 2]) -> Self {
        let ends = span.map(|t| side.at(t));
        let (sagitta, turn) = match *side {
            Side::Line { .. } => (0.0, 0.0),
            Side::Arc { radius, sweep, .. } => {
                let turn = (sweep * (span[1] - span[0])).abs();
                (radius * (1.0 - (0.5 * turn.min(2.0 * PI)).cos()), turn)
            }
            Side::Cubic(_) => hull(side, span, ends),
        };
        Self { side: index, span, ends, sagitta, turn }
    }

    /// The two halves of the piece, cut at the middle of its parameter range; `side` is the side it belongs to.
    pub fn halves(&self, side: &Side) -> [Self; 2] {
        let half = 0.5 * (self.span[0] + self.span[1]);
        [[self.span[0], half], [half, self.span[1]]].map(|span| Self::new(side, self.side, span))
    }

    /// A box along the axes that contains the piece of the curve, widened by `margin` (m).
    pub fn bounds(&self, margin: f64) -> Bounds {
        Bounds::around(&self.ends, self.sagitta + margin)
    }

    /// The angle that the piece subtends at a point (m), in radians, positive anticlockwise. Summed over a rim it is 2π
    /// times the winding number of the rim around the point.
    pub fn seen_from(&self, p: Point, side: &Side) -> f64 {
        let [a, b] = self.ends;
        // Near the curve the chord does not tell on which side the point is: halves do, down to rounding.
        if self.sagitta > 0.0 && self.span[1] - self.span[0] > 1e-12 && from_segment(p, a, b) <= self.sagitta
        {
            return self.halves(side).iter().map(|half| half.seen_from(p, side)).sum();
        }
        angle(minus(a, p), minus(b, p))
    }

    /// Twice the signed area between the piece and its chord, in m²: ∫ x dy - y dx with x and y measured from its start, by
    /// four-point Gauss-Legendre quadrature, which is exact for a cubic.
    pub fn doubled_area(&self, side: &Side) -> f64 {
        let [from, to] = self.span;
        gauss(|t| cross(minus(side.at(t), self.ends[0]), side.derivative(t)), from, to - from)
    }
}

/// Sagitta and turn of a piece of a cubic, from its control polygon.
fn hull(side: &Side, span: [f64; 2], ends: [Point; 2]) -> (f64, f64) {
    let third = (span[1] - span[0]) / 3.0;
    let [d, e] = span.map(|t| side.derivative(t));
    let inner = [
        Point::new(ends[0].x + third * d.x, ends[0].y + third * d.y),
        Point::new(ends[1].x - third * e.x, ends[1].y - third * e.y),
    ];
    let polygon = [ends[0], inner[0], inner[1], ends[1]];
    let size = norm(minus(ends[1], ends[0])).max(norm(minus(inner[1], inner[0])));
    // Control points that coincide have no direction between them.
    let legs: Vec<Point> =
        polygon.windows(2).map(|w| minus(w[1], w[0])).filter(|leg| norm(*leg) > 1e-9 * size).collect();
    let turn = legs.windows(2).map(|w| angle(w[0], w[1]).abs()).sum();
    (inner.iter().map(|p| from_segment(*p, ends[0], ends[1])).fold(0.0, f64::max), turn)
}

/// A side cut into pieces whose tangents each turn by at most 0.1 rad; `index` is the index of the side, counted over all rims.
pub fn pieces(side: &Side, index: usize) -> Vec<Piece> {
    match *side {
        Side::Line { .. } => vec![Piece::new(side, index, [0.0, 1.0])],
        Side::Arc { sweep, .. } => {
            let n = (sweep.abs() / TURN).ceil().clamp(1.0, 1000.0);
            let cut = |i: usize| if i as f64 == n { 1.0 } else { i as f64 / n };
            (0..n as usize).map(|i| Piece::new(side, index, [cut(i), cut(i + 1)])).collect()
        }
        Side::Cubic(_) => {
            let mut found = Vec::new();
            halve(side, Piece::new(side, index, [0.0, 1.0]), DEEPEST, &mut found);
            found
        }
    }
}

fn halve(side: &Side, piece: Piece, depth: u32, found: &mut Vec<Piece>) {
    if piece.turn <= TURN || depth == 0 {
        found.push(piece);
    } else {
        piece.halves(side).into_iter().for_each(|half| halve(side, half, depth - 1, found));
    }
}
