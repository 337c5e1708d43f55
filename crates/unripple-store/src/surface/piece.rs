use unripple_core::{Point, Side};

/// A stretch of a side that turns by less than a right angle, with its chord.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    side: Side,
    range: (f64, f64),
    /// Second derivatives at the ends; of an arc, their constant length.
    bends: (Point, Point),
    /// Where it starts.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// It keeps within this distance of its chord, in metres.
    pub sag: f64,
}

/// A side is halved at most this often to make pieces.
const HALVINGS: u32 = 8;

impl Piece {
    fn new(side: &Side, range: (f64, f64)) -> Self {
        let (from, to) = match *side {
            Side::Line { from, to } => (from, to),
            _ => (side.at(range.0), side.at(range.1)),
        };
        let bend = |t: f64| match side {
            Side::Arc { radius, sweep, .. } => Point::new(radius * sweep * sweep, 0.0),
            _ => side.second_derivative(t),
        };
        Self::between(*side, range, (bend(range.0), bend(range.1)), (from, to))
    }

    fn between(side: Side, range: (f64, f64), bends: (Point, Point), (from, to): (Point, Point)) -> Self {
        // The second derivative of a cubic is linear, so its largest is at an end.
        let square = |b: Point| b.x * b.x + b.y * b.y;
        let width = range.1 - range.0;
        let sag = square(bends.0).max(square(bends.1)).sqrt() * width * width / 8.0;
        Self { side, range, bends, from, to, sag }
    }

    /// All of a side, in order: a line is one piece, a curve at least two.
    pub fn of_side(side: &Side) -> Vec<Self> {
        let mut pieces = Vec::new();
        let mut left = vec![(0.0, 1.0, 0)];
        while let Some((low, high, depth)) = left.pop() {
            let done = side.is_straight() || (depth > 0 && turns_little(side, low, high));
            if done || depth == HALVINGS {
                pieces.push(Self::new(side, (low, high)));
            } else {
                let middle = 0.5 * (low + high);
                left.push((middle, high, depth + 1));
                left.push((low, middle, depth + 1));
            }
        }
        pieces
    }

    pub fn halves(&self) -> [Self; 2] {
        let (low, high) = self.range;
        let middle = 0.5 * (low + high);
        let (first, last) = self.bends;
        let bend = Point::new(0.5 * (first.x + last.x), 0.5 * (first.y + last.y));
        let at = self.side.at(middle);
        [
            Self::between(self.side, (low, middle), (first, bend), (self.from, at)),
            Self::between(self.side, (middle, high), (bend, last), (at, self.to)),
        ]
    }

    /// Whether the piece may cross the ray that runs from a point to the right, or come within `margin` of the point.
    pub fn may_matter_to(&self, p: Point, margin: f64) -> bool {
        let (a, b, reach) = (self.from, self.to, self.sag + margin);
        p.y <= a.y.max(b.y) + reach && p.y >= a.y.min(b.y) - reach && p.x <= a.x.max(b.x) + reach
    }

    /// Whether the piece crosses the ray that runs from a point to the right, as long as the point is farther than `sag`
    /// from the chord.
    pub fn crosses_ray_from(&self, p: Point) -> bool {
        let (a, b) = (self.from, self.to);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)
    }

    /// Distance from a point to the chord.
    pub fn distance_from(&self, p: Point) -> f64 {
        squared(p, self.from, self.to).sqrt()
    }

    /// Length of the chord.
    pub fn chord(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// Distance between the chords; at least `enough` is as good as exact.
    pub fn distance(&self, other: &Self, enough: f64) -> f64 {
        let gap = |a: f64, b: f64, c: f64, d: f64| (a.min(b) - c.max(d)).max(c.min(d) - a.max(b)).max(0.0);
        let (a, b, c, d) = (self.from, self.to, other.from, other.to);
        let apart = gap(a.x, b.x, c.x, d.x).max(gap(a.y, b.y, c.y, d.y));
        if apart > enough {
            return apart;
        }
        if cross((a, b), (c, d)) {
            return 0.0;
        }
        let ends = [squared(a, c, d), squared(b, c, d), squared(c, a, b), squared(d, a, b)];
        ends.into_iter().fold(f64::MAX, f64::min).sqrt()
    }
}

/// Whether no two tangents of the stretch differ by a right angle or more: those of a cubic are within the cone of its
/// derivative's three control points.
fn turns_little(side: &Side, low: f64, high: f64) -> bool {
    let [first, middle, last] = [low, 0.5 * (low + high), high].map(|t| side.derivative(t));
    let control = match side {
        Side::Cubic(_) => {
            Point::new(2.0 * middle.x - 0.5 * (first.x + last.x), 2.0 * middle.y - 0.5 * (first.y + last.y))
        }
        _ => middle,
    };
    let acute = |a: Point, b: Point| a.x * b.x + a.y * b.y > 0.0;
    acute(first, control) && acute(control, last) && acute(first, last)
}

/// Twice the signed area of a triangle; positive when anticlockwise.
pub(super) fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Whether two segments cross or touch.
fn cross((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let apart = |p: f64, q: f64, r: f64, s: f64| p.max(q) < r.min(s) || r.max(s) < p.min(q);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let split = |p: f64, q: f64| (p <= 0.0 && q >= 0.0) || (p >= 0.0 && q <= 0.0);
    split(turn(a, b, c), turn(a, b, d)) && split(turn(c, d, a), turn(c, d, b))
}

/// Distance from a point to a segment, squared.
fn squared(p: Point, from: Point, to: Point) -> f64 {
    let (dx, dy, x, y) = (to.x - from.x, to.y - from.y, p.x - from.x, p.y - from.y);
    let along = ((x * dx + y * dy) / (dx * dx + dy * dy).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (x - along * dx).powi(2) + (y - along * dy).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_keep_to_their_chords() {
        let p = Point::new;
        let sides = [
            Side::Arc { centre: p(0.2, 0.1), radius: 0.3, start: 1.0, sweep: -6.0 },
            Side::Cubic([p(0.0, 0.0), p(0.9, 0.4), p(-0.8, 0.5), p(0.2, -0.1)]),
        ];
        for side in sides {
            let pieces = Piece::of_side(&side);
            assert!(pieces.len() > 1);
            assert!(pieces.windows(2).all(|w| w[0].to == w[1].from));
            for piece in pieces.iter().chain(&pieces[0].halves()) {
                for i in 0..=100 {
                    let t = piece.range.0 + (piece.range.1 - piece.range.0) * f64::from(i) / 100.0;
                    assert!(squared(side.at(t), piece.from, piece.to).sqrt() <= piece.sag * (1.0 + 1e-9));
                }
            }
        }
    }
}
