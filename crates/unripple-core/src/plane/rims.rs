//! The rims (boundary curves) of an outline cut into short pieces, and distances across the sheet.

use super::piece::Piece;
use super::tree::{Bounds, Node, Tree};
use super::vector::{along, angle, cross, minus, norm};
use crate::{Edge, Point, Side};
use std::f64::consts::PI;
use std::ops::Range;

/// All rims (closed boundary curves) of an outline: the outer one and those of the holes, with the sheet to their left.
///
/// Sides and pieces are numbered consecutively over all rims, in order.
#[derive(Clone, Debug)]
pub struct Rims {
    /// All sides and their edge conditions, rim by rim.
    pub sides: Vec<(Side, Edge)>,
    /// The range of side indices of each rim, the outer rim first.
    pub loops: Vec<Range<usize>>,
    /// The rim of each side.
    rims: Vec<usize>,
    /// The interior angle of the sheet at the corner where each side starts, in radians from 0 to 2π.
    pub angles: Vec<f64>,
    /// All sides cut into short pieces, in order.
    pub pieces: Vec<Piece>,
    /// The first piece of each side.
    firsts: Vec<usize>,
    /// Bounding boxes of the pieces, for searches.
    pub tree: Tree,
    /// The longer side of the bounding box around all rims, in metres.
    pub extent: f64,
}

impl Rims {
    /// Rims of valid sides, without the check that they enclose a sheet; `loops` holds the index range of each rim's
    /// sides.
    pub(super) fn of(sides: Vec<(Side, Edge)>, loops: Vec<Range<usize>>) -> Self {
        let rims: Vec<usize> =
            loops.iter().enumerate().flat_map(|(rim, sides)| sides.clone().map(move |_| rim)).collect();
        let mut pieces: Vec<Piece> = Vec::new();
        let mut firsts = Vec::with_capacity(sides.len());
        for (i, (side, _)) in sides.iter().enumerate() {
            firsts.push(pieces.len());
            pieces.extend(super::piece::pieces(side, i));
        }
        let boxes: Vec<(Bounds, f64)> = pieces.iter().map(|piece| (piece.bounds(0.0), 0.0)).collect();
        let all = pieces.iter().flat_map(|piece| piece.ends).collect::<Vec<_>>();
        let bounds = Bounds::around(&all, 0.0);
        let extent = (bounds.high.x - bounds.low.x).max(bounds.high.y - bounds.low.y);
        let tree = Tree::new(&boxes);
        let mut found = Self { sides, loops, rims, angles: Vec::new(), pieces, firsts, tree, extent };
        found.angles = (0..found.sides.len()).map(|i| found.angle(i)).collect();
        found
    }

    /// Index of the rim that a side belongs to.
    pub fn rim_of(&self, side: usize) -> usize {
        self.rims.get(side).copied().unwrap_or(0)
    }

    /// Index of the next side on the same rim; after the last side comes the first.
    pub fn next(&self, side: usize) -> usize {
        let rim = &self.loops[self.rim_of(side)];
        if side + 1 < rim.end { side + 1 } else { rim.start }
    }

    /// Index of the previous side on the same rim; before the first side comes the last.
    pub fn previous(&self, side: usize) -> usize {
        let rim = &self.loops[self.rim_of(side)];
        if side > rim.start { side - 1 } else { rim.end - 1 }
    }

    /// Index of the next piece on the same rim.
    pub(super) fn following(&self, piece: usize) -> usize {
        let side = self.pieces[piece].side;
        match self.pieces.get(piece + 1) {
            Some(next) if next.side == side => piece + 1,
            _ => self.firsts[self.next(side)],
        }
    }

    /// Whether `other` starts where `one` ends.
    pub(super) fn follows(&self, one: &Piece, other: &Piece) -> bool {
        let inner = one.side == other.side && one.span[1] == other.span[0];
        inner || (one.span[1] == 1.0 && other.span[0] == 0.0 && self.next(one.side) == other.side)
    }

    /// Signed area within a rim, in m², positive anticlockwise.
    pub(super) fn area(&self, rim: usize) -> f64 {
        let origin = self.sides[self.loops[rim].start].0.at(0.0);
        let piece = |piece: &Piece| {
            let [a, b] = piece.ends.map(|p| minus(p, origin));
            piece.doubled_area(&self.sides[piece.side].0) + a.x * b.y - a.y * b.x
        };
        0.5 * self.of_rim(rim).map(piece).sum::<f64>()
    }

    /// Winding number of a rim around a point (m) that is not on it, positive anticlockwise.
    pub(super) fn winding(&self, rim: usize, p: Point) -> i64 {
        let angle: f64 = self.of_rim(rim).map(|piece| piece.seen_from(p, &self.sides[piece.side].0)).sum();
        (angle / (2.0 * PI)).round() as i64
    }

    /// The pieces of one rim.
    fn of_rim(&self, rim: usize) -> impl Iterator<Item = &Piece> {
        let sides = self.loops[rim].clone();
        let piece = |side: usize| self.firsts.get(side).copied().unwrap_or(self.pieces.len());
        self.pieces[piece(sides.start)..piece(sides.end)].iter()
    }

    /// Interior angle of the sheet at the start of a side, 0 to 2π.
    fn angle(&self, side: usize) -> f64 {
        let before = tangent(&self.sides[self.previous(side)].0, 1.0);
        PI - angle(before, tangent(&self.sides[side].0, 0.0))
    }

    /// Width of the sheet, in metres, from the point at parameter `t` of a side to the opposite boundary
    /// along a unit vector `direction`; infinite if it exceeds `most` (m). Near a sharp corner, the other
    /// side of the corner does not count as opposite.
    pub fn gap(&self, side: usize, t: f64, direction: Point, most: f64) -> f64 {
        let from = self.sides[side].0.at(t);
        let beam = Bounds::around(&[from, along(from, direction, most)], 0.0);
        let mut found = f64::INFINITY;
        let open = |_: &f64, node: &Node| node.bounds.meets(&beam);
        self.tree.search(&mut found, open, |found, i| {
            let piece = &self.pieces[i];
            let beside = piece.side == side && piece.span[0] <= t && t <= piece.span[1];
            let [a, b] = piece.ends;
            let (chord, to) = (minus(b, a), minus(a, from));
            // The opposite boundary has the sheet to its left too, so only pieces that cross the ray in one sense count.
            let facing = cross(direction, chord);
            let (far, share) = (cross(to, chord) / facing, cross(to, direction) / facing);
            if facing > 0.0 && !beside && far > 0.0 && far < *found && (0.0..=1.0).contains(&share) {
                let far = (far - piece.sagitta).max(0.5 * far);
                if !self.expected(side, from, piece, far) {
                    *found = far;
                }
            }
        });
        if found <= most { found } else { f64::INFINITY }
    }

    /// Whether the distance of a piece is explained by a sharp corner between the side of the piece and the
    /// given side.
    fn expected(&self, side: usize, from: Point, piece: &Piece, far: f64) -> bool {
        let narrow = |corner: usize| {
            let opening = self.angles[corner];
            let apart = from.distance(self.sides[corner].0.at(0.0));
            opening < 0.5 * PI && far > 0.5 * apart * opening.sin()
        };
        let next = self.next(side);
        let same = piece.side == side && far < piece.sagitta + 0.1 * piece.ends[0].distance(piece.ends[1]);
        same || (piece.side == next && narrow(next)) || (piece.side == self.previous(side) && narrow(side))
    }
}

/// A vector along the tangent of a side at parameter `t` (0 to 1). Its length (m) is arbitrary, but not
/// zero even where the derivative vanishes.
pub fn tangent(side: &Side, t: f64) -> Point {
    let d = side.derivative(t);
    if norm(d) > 1e-9 * side.length() {
        return d;
    }
    // Where control points coincide a secant over a thousandth of the side stands for the tangent.
    minus(side.at((t + 1e-3).min(1.0)), side.at((t - 1e-3).max(0.0)))
}
