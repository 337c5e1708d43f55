//! Where curves meet that should not. Pieces are compared by their chords and split only where these come near, so what
//! is told is told of the curves themselves, not of a polygon through them.

use super::bounds::Bounds;
use super::piece::{Piece, turn};
use std::collections::BTreeSet;
use unripple_core::{Point, Side};

/// Curves nearer than this meet, in metres.
const TOUCH: f64 = 1e-12;
/// Halvings at a joint before it counts as folded back.
const DEEPEST: u32 = 24;
/// Most pairs of pieces looked at in one question, and most times that pieces are split.
const MOST_PAIRS: u64 = 30_000_000;
const MOST_SPLITS: u64 = 4_000_000;

/// What is left of the work that one question may take.
struct Work {
    pairs: u64,
    splits: u64,
}

impl Work {
    const ALL: Self = Self { pairs: MOST_PAIRS, splits: MOST_SPLITS };

    /// Counts a pair; `false` if anything is used up.
    fn pair(&mut self) -> bool {
        self.pairs = self.pairs.saturating_sub(1);
        self.pairs > 0 && self.splits > 0
    }

    fn split(&mut self) -> bool {
        self.splits = self.splits.saturating_sub(1);
        self.splits > 0
    }
}

/// Two of many curves that meet, by their indices, the smaller first; or that there is too much to compare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meeting {
    Pair(usize, usize),
    TooMany,
}

/// The first pair of sides of a closed curve that meet where they should not, or of a side with itself.
pub(super) fn within(sides: &[Side]) -> Option<Meeting> {
    let pieces: Vec<(usize, Piece)> = sides
        .iter()
        .enumerate()
        .flat_map(|(i, side)| Piece::of_side(side).into_iter().map(move |p| (i, p)))
        .collect();
    let mut work = Work::ALL;
    let mut first: Option<(usize, usize)> = None;
    let swept = sweep(&pieces, 0.0, &mut work, |i, j, work| {
        let ((side, a), (other, b)) = (&pieces[i], &pieces[j]);
        let pair = (*side, *other);
        if first.is_some_and(|first| first <= pair) {
            return;
        }
        let meet = if j == i + 1 {
            fold(a, b, DEEPEST, work)
        } else if (j + 1) % pieces.len() == i {
            fold(b, a, DEEPEST, work)
        } else {
            near(a, b, TOUCH, work)
        };
        if meet {
            first = Some(pair);
        }
    });
    if swept { first.map(|(i, j)| Meeting::Pair(i, j)) } else { Some(Meeting::TooMany) }
}

/// For each of several closed curves, the first before it that comes nearer than `clear` metres.
pub(super) fn between(curves: &[Vec<Side>], clear: f64) -> Option<Vec<Option<usize>>> {
    let pieces: Vec<(usize, Piece)> = curves
        .iter()
        .enumerate()
        .flat_map(|(i, sides)| sides.iter().flat_map(Piece::of_side).map(move |p| (i, p)))
        .collect();
    let mut work = Work::ALL;
    let mut met: BTreeSet<(usize, usize)> = BTreeSet::new();
    let swept = sweep(&pieces, clear, &mut work, |i, j, work| {
        let ((one, a), (other, b)) = (&pieces[i], &pieces[j]);
        let pair = (*one.max(other), *one.min(other));
        if one != other && !met.contains(&pair) && near(a, b, clear, work) {
            met.insert(pair);
        }
    });
    let first = |i: usize| met.range((i, 0)..(i + 1, 0)).next().map(|(_, other)| *other);
    swept.then(|| (0..curves.len()).map(first).collect())
}

/// Hands over each pair of pieces i < j whose boxes are nearer than `clear`; `false` if there are too many.
fn sweep(
    pieces: &[(usize, Piece)],
    clear: f64,
    work: &mut Work,
    mut judge: impl FnMut(usize, usize, &mut Work),
) -> bool {
    let span = |along: fn(Point) -> f64, p: &Piece| {
        let (a, b, margin) = (along(p.from), along(p.to), p.sag + 0.5 * clear + TOUCH);
        (a.min(b) - margin, a.max(b) + margin)
    };
    let axes: [fn(Point) -> f64; 2] = [|p| p.x, |p| p.y];
    let spans = axes.map(|along| pieces.iter().map(|(_, p)| span(along, p)).collect::<Vec<_>>());
    // Along the axis in which pieces are short, fewer overlap.
    let long = spans.each_ref().map(|list| list.iter().map(|(low, high)| high - low).sum::<f64>());
    let [along, across] = if long[0] <= long[1] { [&spans[0], &spans[1]] } else { [&spans[1], &spans[0]] };
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|a, b| along[*a].0.total_cmp(&along[*b].0));
    for (place, &i) in order.iter().enumerate() {
        for &j in order[place + 1..].iter().take_while(|j| along[**j].0 <= along[i].1) {
            if !work.pair() {
                return false;
            }
            if across[i].0 <= across[j].1 && across[j].0 <= across[i].1 {
                judge(i.min(j), i.max(j), work);
            }
        }
    }
    work.pair()
}

/// Whether two pieces come nearer than `clear`.
fn near(a: &Piece, b: &Piece, clear: f64, work: &mut Work) -> bool {
    let blur = a.sag + b.sag;
    let distance = a.distance(b, clear + blur);
    if distance > clear + blur {
        return false;
    }
    if blur <= TOUCH || distance + blur < clear {
        return true;
    }
    if !work.split() {
        return false;
    }
    let (bent, other) = if a.sag >= b.sag { (a, b) } else { (b, a) };
    bent.halves().iter().any(|half| near(half, other, clear, work))
}

/// Whether two pieces of which the second starts where the first ends meet again elsewhere, or run back over each other.
fn fold(a: &Piece, b: &Piece, depth: u32, work: &mut Work) -> bool {
    if a.sag == 0.0 && b.sag == 0.0 {
        return folds_back(a.from, a.to, b.to);
    }
    // A stretch that sags by a share s of its chord stays within an angle of 4 s of it.
    let cones = 5.0 * (a.sag / a.chord() + b.sag / b.chord());
    if cones < 0.5 && angle(a.from, a.to, b.to) > cones {
        return false;
    }
    if depth == 0 || !work.split() {
        return true;
    }
    let ([a1, a2], [b1, b2]) = (a.halves(), b.halves());
    near(&a1, &b1, TOUCH, work)
        || near(&a1, &b2, TOUCH, work)
        || near(&a2, &b2, TOUCH, work)
        || fold(&a2, &b1, depth - 1, work)
}

/// The angle at `b` between the ways to `a` and to `c`, in radians.
fn angle(a: Point, b: Point, c: Point) -> f64 {
    let dot = (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y);
    turn(a, b, c).abs().atan2(dot)
}

/// Whether the side from `b` to `c` runs back over the side from `a` to `b`.
fn folds_back(a: Point, b: Point, c: Point) -> bool {
    let dot = (a.x - b.x) * (c.x - b.x) + (a.y - b.y) * (c.y - b.y);
    turn(a, b, c).abs() <= 1e-12 * a.distance(b) * b.distance(c) && dot > 0.0
}

/// Whether the bounds of two curves leave room for one within the other.
pub(super) fn may_nest(inner: &Bounds, outer: &Bounds) -> bool {
    outer.hold(inner.least, 0.0) && outer.hold(inner.greatest, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Hole, Shape};

    fn polygon(points: &[(f64, f64)]) -> Vec<Side> {
        Shape::Polygon(points.iter().map(|&(x, y)| Point::new(x, y)).collect()).sides()
    }

    #[test]
    fn sees_crossings_and_spikes() {
        let bow = polygon(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.5)]);
        assert_eq!(within(&bow), Some(Meeting::Pair(0, 2)));
        let spike = polygon(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.0), (0.5, 1.0)]);
        assert_eq!(within(&spike), Some(Meeting::Pair(0, 1)));
        let notch = polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.2), (0.0, 1.0)]);
        assert_eq!(within(&notch), None);
        let pinched = polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.0), (0.0, 1.0)]);
        assert_eq!(within(&pinched), Some(Meeting::Pair(0, 2)));
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
        assert_eq!(within(&leaf(1e-7)), None);
        assert_eq!(within(&leaf(0.0)), Some(Meeting::Pair(0, 1)));
        let looped = vec![
            Side::Cubic([p(0.0, 0.0), p(0.5, 0.3), p(-0.2, 0.3), p(0.3, 0.0)]),
            Side::Line { from: p(0.3, 0.0), to: p(0.15, -0.3) },
            Side::Line { from: p(0.15, -0.3), to: p(0.0, 0.0) },
        ];
        assert_eq!(within(&looped), Some(Meeting::Pair(0, 0)));
        // The middle of the curve dips by 3/4 of its handles.
        let dipping = |to: f64| {
            vec![
                Side::Line { from: p(0.0, 0.0), to: p(1.0, 0.0) },
                Side::Line { from: p(1.0, 0.0), to: p(1.0, 0.6) },
                Side::Cubic([p(1.0, 0.6), p(0.7, 0.6 - to / 0.75), p(0.3, 0.6 - to / 0.75), p(0.0, 0.6)]),
                Side::Line { from: p(0.0, 0.6), to: p(0.0, 0.0) },
            ]
        };
        assert_eq!(within(&dipping(0.6 - 1e-9)), None);
        assert_eq!(within(&dipping(0.6 + 1e-9)), Some(Meeting::Pair(0, 2)));
    }

    #[test]
    fn rims_are_kept_apart() {
        let circle = |radius: f64, x: f64, y: f64| {
            let corner = Point::new(x - radius, y - radius);
            Hole::new(&Shape::Circle { radius }, corner).sides()
        };
        let rim = circle(0.07, 0.07, 0.07);
        let beside = |gap: f64| {
            between(
                &[rim.clone(), circle(0.01, 0.01 + gap, 0.07), circle(0.01, 0.03 + 2.0 * gap, 0.07)],
                1e-6,
            )
        };
        assert_eq!(beside(1.01e-6), Some(vec![None, None, None]));
        assert_eq!(beside(0.99e-6), Some(vec![None, Some(0), Some(1)]));
    }

    #[test]
    fn too_much_is_said_and_soon() {
        let lines: Vec<Side> = (0..30_000)
            .map(|i| {
                let x = f64::from(i) * 1e-9;
                Side::Line { from: Point::new(x, 0.0), to: Point::new(x + 1.0, 1.0) }
            })
            .collect();
        assert_eq!(within(&lines), Some(Meeting::TooMany));
    }
}
