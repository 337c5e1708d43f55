//! Places where rims (boundary curves) cross or touch each other or themselves. Pieces of curves are
//! compared by their chords and halved where the chords come near each other, so that the result holds for
//! the curves themselves, not for polygons through them.

use super::piece::Piece;
use super::rims::{Rims, tangent};
use super::tree::Node;
use super::vector::{along, angle, between_segments, cross, from_segment, minus};
use crate::{Point, Side};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Pieces of one rim that are nearer to each other than this distance, relative to the extent, count as
/// touching: a mesh of anything closer has more triangles than any memory holds.
const TOUCH: f64 = 1e-7;
/// Least distance between different rims, in metres. With twice this value, strips of sheet up to 2 µm wide would be
/// refused as well.
const CLEAR: f64 = 1e-6;
/// Least angle between sides that meet, in radians (0.6°): sharper corners would need needles for triangles.
/// With twice this value, corners up to 1.1° would be refused.
const SHARPEST: f64 = 0.01;
/// Halvings after which two pieces that cannot be told apart are taken to meet: parameters then differ in the
/// last bits only.
const DEEPEST: u32 = 60;
/// Pieces are halved until their sagittas are below this share of the least distance allowed, so that the comparison with it
/// errs by a thousandth. Halved, curves that nearly touch take about one more halving.
const BLUR: f64 = 1e-3;
/// Largest number of pairs of pieces that are compared: with the two limits below, about a second. Outlines that need more have
/// sides that lie along each other. With twice this value, such outlines would be refused after twice the time.
const MOST_PAIRS: u64 = 5_000_000;
/// Largest number of times that pieces are halved, for the same bound on time.
const MOST_HALVINGS: u64 = 4_000_000;
/// Largest number of pairs of rims that meet before the search ends, for the same bound on time.
const MOST_MEETINGS: usize = 10_000;

/// The result of [`within`]: two sides of a closed curve that cross or touch, or a search that stopped at
/// its limit of work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Met {
    /// Two sides meet: their indices in the list of sides, the smaller first, and a point (m) where they
    /// meet.
    Sides([usize; 2], Point),
    /// The search stopped at its limit of work: sides lie along each other in too many places.
    TooMany,
}

/// Checks a closed curve, given by its sides in order, for sides that cross or touch; `None` if there are
/// none. Consecutive sides that fold back on each other are reported before all others; otherwise the pair
/// with the smallest indices is reported.
pub fn within(sides: &[Side]) -> Option<Met> {
    let all = sides.iter().map(|side| (*side, crate::Edge::Free)).collect();
    let rims = Rims::of(all, std::iter::once(0..sides.len()).collect());
    match meetings(&rims) {
        Ok(found) => found.into_values().next().map(|(sides, at)| Met::Sides(sides, at)),
        Err(Endless) => Some(Met::TooMany),
    }
}

/// For each pair of rims that meet (also of a rim with itself): the indices of two sides that meet, counted over all rims, and the place.
pub(super) type Meetings = BTreeMap<[usize; 2], ([usize; 2], Point)>;

/// The search exceeded one of the limits above.
pub(super) struct Endless;

/// The work that one search may still do: numbers of pairs of pieces to compare and of pieces to halve.
struct Work {
    pairs: u64,
    halvings: u64,
}

impl Work {
    /// Counts one pair of pieces compared.
    fn pair(&mut self) {
        self.pairs = self.pairs.saturating_sub(1);
    }

    /// Counts one piece halved.
    fn halve(&mut self) {
        self.halvings = self.halvings.saturating_sub(1);
    }

    /// Whether the allowed work is used up.
    fn is_done(&self) -> bool {
        self.pairs == 0 || self.halvings == 0
    }
}

/// All pairs of rims that meet.
pub(super) fn meetings(rims: &Rims) -> Result<Meetings, Endless> {
    let touch = TOUCH * rims.extent;
    let mut search =
        Search { rims, work: Work { pairs: MOST_PAIRS, halvings: MOST_HALVINGS }, found: Meetings::new() };
    search.joints(touch);
    search.others(touch, touch.max(CLEAR));
    search.cusps();
    if search.is_done() { Err(Endless) } else { Ok(search.found) }
}

/// A search for places where rims meet.
struct Search<'r> {
    rims: &'r Rims,
    work: Work,
    found: Meetings,
}

impl Search<'_> {
    /// Whether the search has reached one of its limits.
    fn is_done(&self) -> bool {
        self.work.is_done() || self.found.len() > MOST_MEETINGS
    }

    /// Notes that two sides, given by their indices over all rims, meet at a place.
    fn add(&mut self, one: usize, other: usize, at: Point) {
        let sides = [one.min(other), one.max(other)];
        let pair = sides.map(|side| self.rims.rim_of(side));
        let new = (sides, at);
        // Of each pair of rims the sides of smallest indices are kept, whatever the order in which they are found.
        let known = self.found.entry(pair).or_insert(new);
        if known.0 > sides {
            *known = new;
        }
    }

    /// Finds consecutive pieces that fold back on each other.
    fn joints(&mut self, touch: f64) {
        let rims = self.rims;
        for i in 0..rims.pieces.len() {
            let j = rims.following(i);
            let (one, other) = (&rims.pieces[i], &rims.pieces[j]);
            self.work.pair();
            if i != j
                && let Some(at) = self.at_joint(one, other, touch, DEEPEST)
            {
                self.add(one.side, other.side, at);
            }
        }
    }

    /// Finds pieces that meet and are not consecutive. A rim that was found to fold back is not compared with itself.
    fn others(&mut self, touch: f64, clear: f64) {
        let rims = self.rims;
        let folded: Vec<usize> = self.found.keys().map(|[rim, _]| *rim).collect();
        for (i, piece) in rims.pieces.iter().enumerate() {
            let own = piece.bounds(clear);
            let rim = rims.rim_of(piece.side);
            let mut near = Vec::new();
            let open = |_: &Vec<usize>, node: &Node| node.bounds.meets(&own);
            rims.tree.search(&mut near, open, |near, j| near.extend((j > i).then_some(j)));
            for j in near {
                if self.is_done() {
                    return;
                }
                self.work.pair();
                let other = &rims.pieces[j];
                let same = rims.rim_of(other.side) == rim;
                if (same && folded.contains(&rim)) || self.is_known(piece.side, other.side) {
                    continue;
                }
                if let Some(at) = self.meet(piece, other, if same { touch } else { clear }, DEEPEST) {
                    self.add(piece.side, other.side, at);
                }
            }
        }
    }

    /// Whether these sides, or sides of smaller indices on the same rims, are known to meet.
    fn is_known(&self, one: usize, other: usize) -> bool {
        let sides = [one.min(other), one.max(other)];
        self.found.get(&sides.map(|side| self.rims.rim_of(side))).is_some_and(|known| known.0 <= sides)
    }

    /// Finds cusps: points where a curve reverses its direction.
    fn cusps(&mut self) {
        let rims = self.rims;
        for piece in rims.pieces.iter().filter(|piece| piece.turn > PI - SHARPEST) {
            if !self.is_known(piece.side, piece.side) {
                self.add(piece.side, piece.side, piece.ends[0]);
            }
        }
    }

    /// A point where two pieces are nearer than `clear` (m); an end that consecutive pieces share does not count.
    fn meet(&mut self, one: &Piece, other: &Piece, clear: f64, depth: u32) -> Option<Point> {
        let curved = one.sagitta + other.sagitta;
        if between_segments(one.ends, other.ends) > curved + clear {
            return None;
        }
        if self.rims.follows(one, other) {
            return self.at_joint(one, other, clear, depth);
        }
        if self.rims.follows(other, one) {
            return self.at_joint(other, one, clear, depth);
        }
        if curved < BLUR * clear || depth == 0 {
            return Some(nearest(one.ends, other.ends));
        }
        if self.is_done() {
            return None;
        }
        self.work.halve();
        if one.sagitta >= other.sagitta {
            let halves = one.halves(&self.rims.sides[one.side].0);
            halves.iter().find_map(|half| self.meet(half, other, clear, depth - 1))
        } else {
            let halves = other.halves(&self.rims.sides[other.side].0);
            halves.iter().find_map(|half| self.meet(one, half, clear, depth - 1))
        }
    }

    /// A point where two consecutive pieces meet other than at the end they share. If their tangents turn by less than the angle
    /// between them, they have only that end in common.
    fn at_joint(&mut self, one: &Piece, other: &Piece, clear: f64, depth: u32) -> Option<Point> {
        let rims = self.rims;
        let back = tangent(&rims.sides[one.side].0, one.span[1]);
        let on = tangent(&rims.sides[other.side].0, other.span[0]);
        let opening = PI - angle(back, on).abs();
        if opening < SHARPEST || depth == 0 {
            return Some(other.ends[0]);
        }
        if one.turn + other.turn < opening && !rims.follows(other, one) {
            return None;
        }
        if self.is_done() {
            return None;
        }
        self.work.halve();
        let (near, far) = if one.turn >= other.turn {
            let [far, near] = one.halves(&rims.sides[one.side].0);
            ([near, *other], [far, *other])
        } else {
            let [near, far] = other.halves(&rims.sides[other.side].0);
            ([*one, near], [*one, far])
        };
        self.meet(&far[0], &far[1], clear, depth - 1)
            .or_else(|| self.at_joint(&near[0], &near[1], clear, depth - 1))
    }
}

/// The point where two segments cross, or else the end of one of them that is nearest to the other.
fn nearest([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Point {
    let (ab, cd, ac) = (minus(b, a), minus(d, c), minus(c, a));
    let (s, t) = (cross(ac, cd) / cross(ab, cd), cross(ac, ab) / cross(ab, cd));
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        return along(a, ab, s);
    }
    let from = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])];
    let apart = |(p, [q, r]): &(Point, [Point; 2])| from_segment(*p, *q, *r);
    from.into_iter().min_by(|x, y| apart(x).total_cmp(&apart(y))).map_or(a, |(p, _)| p)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Hole, Outline, OutlineFault, Shape};

    fn polygon(points: &[(f64, f64)]) -> Vec<Side> {
        Shape::Polygon(points.iter().map(|&(x, y)| Point::new(x, y)).collect()).sides()
    }

    fn sides(points: &[(f64, f64)]) -> Option<[usize; 2]> {
        pair(&polygon(points))
    }

    fn pair(sides: &[Side]) -> Option<[usize; 2]> {
        within(sides).map(|met| match met {
            Met::Sides(sides, _) => sides,
            Met::TooMany => panic!("too many"),
        })
    }

    #[test]
    fn sees_crossings_and_spikes() {
        assert_eq!(sides(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.5)]), Some([0, 2]));
        assert_eq!(sides(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.0), (0.5, 1.0)]), Some([0, 1]));
        assert_eq!(sides(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.2), (0.0, 1.0)]), None);
        assert_eq!(sides(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.0), (0.0, 1.0)]), Some([0, 2]));
    }

    #[test]
    fn sharp_corners_and_thin_slots_are_told_where_they_are() {
        let sharp = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.06), (0.06, 0.06), (0.06, 0.0003)];
        assert_eq!(within(&polygon(&sharp)), Some(Met::Sides([0, 4], Point::new(0.0, 0.0))));
        let slot = [
            (0.0, 0.0),
            (0.1, 0.0),
            (0.1, 0.06),
            (0.050_000_004, 0.06),
            (0.050_000_002, 0.01),
            (0.05, 0.06),
            (0.0, 0.06),
        ];
        assert_eq!(within(&polygon(&slot)), Some(Met::Sides([3, 4], Point::new(0.050_000_002, 0.01))));
    }

    #[test]
    fn curves_are_judged_as_curves() {
        let p = Point::new;
        for shape in [Shape::Circle { radius: 0.07 }, Shape::Stadium { straight: 0.06, radius: 0.04 }] {
            assert_eq!(within(&shape.sides()), None);
        }
        let slit = Hole::slit(p(0.02, 0.03), p(0.09, 0.05), 1e-5);
        assert_eq!(within(&slit.sides), None);
        let leaf = |bend: f64| {
            vec![
                Side::Cubic([p(0.0, 0.0), p(0.1, -bend), p(0.2, -bend), p(0.3, 0.0)]),
                Side::Cubic([p(0.3, 0.0), p(0.2, bend), p(0.1, bend), p(0.0, 0.0)]),
            ]
        };
        assert_eq!(within(&leaf(0.1)), None);
        // Corners of 0.02 rad, and of 0.002.
        assert_eq!(within(&leaf(1e-3)), None);
        assert_eq!(pair(&leaf(1e-4)), Some([0, 1]));
        assert_eq!(pair(&leaf(0.0)), Some([0, 1]));
        let looped = vec![
            Side::Cubic([p(0.0, 0.0), p(0.5, 0.3), p(-0.2, 0.3), p(0.3, 0.0)]),
            Side::Line { from: p(0.3, 0.0), to: p(0.15, -0.3) },
            Side::Line { from: p(0.15, -0.3), to: p(0.0, 0.0) },
        ];
        assert_eq!(pair(&looped), Some([0, 0]));
        // The middle of the curve dips by 3/4 of its handles.
        let dipping = |to: f64| {
            vec![
                Side::Line { from: p(0.0, 0.0), to: p(1.0, 0.0) },
                Side::Line { from: p(1.0, 0.0), to: p(1.0, 0.6) },
                Side::Cubic([p(1.0, 0.6), p(0.7, 0.6 - to / 0.75), p(0.3, 0.6 - to / 0.75), p(0.0, 0.6)]),
                Side::Line { from: p(0.0, 0.6), to: p(0.0, 0.0) },
            ]
        };
        assert_eq!(within(&dipping(0.6 - 1.01e-7)), None);
        assert_eq!(pair(&dipping(0.6 - 0.99e-7)), Some([0, 2]));
        let Some(Met::Sides(_, at)) = within(&dipping(0.6)) else { panic!("nothing meets") };
        assert!(at.distance(p(0.5, 0.0)) < 1e-3, "{at}");
    }

    #[test]
    fn rims_are_kept_apart() {
        let disc = |radius: f64, x: f64, y: f64| {
            Hole::new(&Shape::Circle { radius }, Point::new(x - radius, y - radius))
        };
        let beside = |gap: f64| {
            let outline = Outline::new(Shape::Circle { radius: 0.07 })
                .with_hole(disc(0.01, 0.01 + gap, 0.07))
                .with_hole(disc(0.01, 0.03 + 2.0 * gap, 0.07));
            let met = outline.faults().into_iter().map(|fault| match fault {
                OutlineFault::Meeting { rims, .. } => rims,
                other => panic!("{other}"),
            });
            met.collect::<Vec<_>>()
        };
        assert_eq!(beside(1.01e-6), Vec::<[usize; 2]>::new());
        assert_eq!(beside(0.99e-6), [[0, 1], [1, 2]]);
    }

    #[test]
    fn too_much_is_said_and_soon() {
        // Slits without width that lie beside each other by thousands.
        let comb = |i: usize| {
            let x = i as f64 * 2e-7;
            let (from, to) = (Point::new(x, 0.0), Point::new(x + 1e-3, 1.0));
            Hole {
                sides: vec![Side::Line { from, to }, Side::Line { from: to, to: from }],
                at: Point::new(0.0, 0.0),
                edges: crate::Edges::All(crate::Edge::Free),
            }
        };
        let mut outline = Outline::new(Shape::Rectangle { width: 2.0, height: 2.0 });
        outline.holes = (0..8000).map(comb).collect();
        assert_eq!(outline.faults(), [OutlineFault::TooMany]);
    }
}
