//! One edge of a triangle, straight or a piece of a curve.

use unripple_core::{Edge, Point, Side};

/// Largest turn of a curve, in radians, over which quadrature is done without cutting the curve. With twice
/// this value, quadrature rules apply to curves that turn by up to 1.6 rad, and converge more slowly.
const TURN: f64 = 0.8;

/// One edge of a triangle, described by a parameter from 0 to 1; the triangle lies to its left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Border {
    /// The side of a rim, or the line, of which the border is a piece.
    pub(crate) side: Side,
    /// The side's parameter where the border starts.
    pub(crate) from: f64,
    /// The side's parameter where the border ends.
    pub(crate) to: f64,
    /// The edge condition if the border is on a rim; `None` inside the sheet.
    pub(crate) held: Option<Edge>,
}

impl Border {
    /// A straight line inside the sheet, from one point to another (m).
    pub(crate) fn line(from: Point, to: Point) -> Self {
        Self { side: Side::Line { from, to }, from: 0.0, to: 1.0, held: None }
    }

    /// The point at parameter `s` (0 to 1), in metres.
    pub(crate) fn at(&self, s: f64) -> Point {
        self.side.at(self.from + s * (self.to - self.from))
    }

    /// The first derivative with respect to the parameter, at `s` (0 to 1), in metres.
    pub(crate) fn derivative(&self, s: f64) -> Point {
        let (width, d) = (self.to - self.from, self.side.derivative(self.from + s * (self.to - self.from)));
        Point::new(width * d.x, width * d.y)
    }

    /// The unit tangent and the unit normal to its left at parameter `s`.
    pub(crate) fn directions(&self, s: f64) -> ([f64; 2], [f64; 2]) {
        let d = self.derivative(s);
        let size = d.x.hypot(d.y);
        ([d.x / size, d.y / size], [-d.y / size, d.x / size])
    }

    /// Whether the border is straight, so that quadrature along it is exact.
    pub(crate) fn is_straight(&self) -> bool {
        self.side.is_straight()
    }

    /// The piece between two of its parameters, 0 to 1.
    pub(crate) fn piece(&self, from: f64, to: f64) -> Self {
        let along = |s: f64| self.from + s * (self.to - self.from);
        Self { from: along(from), to: along(to), ..*self }
    }

    /// The border cut into pieces that turn by at most [`TURN`], for Gauss-Legendre quadrature.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = Self> {
        let count = ((self.turn() / TURN).ceil() as usize).max(1);
        let whole = *self;
        (0..count).map(move |i| whole.piece(i as f64 / count as f64, (i + 1) as f64 / count as f64))
    }

    /// Angle by which the border turns, in radians.
    fn turn(&self) -> f64 {
        match self.side {
            Side::Line { .. } => 0.0,
            Side::Arc { sweep, .. } => (sweep * (self.to - self.from)).abs(),
            Side::Cubic(_) => (0..8)
                .map(|i| {
                    let (a, b) =
                        (self.derivative(f64::from(i) / 8.0), self.derivative(f64::from(i + 1) / 8.0));
                    (a.x * b.y - a.y * b.x).atan2(a.x * b.x + a.y * b.y).abs()
                })
                .sum(),
        }
    }

    /// Distance of a point to the left of the border, in metres. For a curve, it is measured perpendicular
    /// to the chord; beyond the ends of the chord, it is the distance from the line through the chord.
    pub(crate) fn left_of(&self, p: Point) -> f64 {
        let (a, b) = (self.at(0.0), self.at(1.0));
        let (cx, cy) = (b.x - a.x, b.y - a.y);
        let length = cx.hypot(cy);
        let along = |q: Point| ((q.x - a.x) * cx + (q.y - a.y) * cy) / (length * length);
        let height = |q: Point| (cx * (q.y - a.y) - cy * (q.x - a.x)) / length;
        let foot = along(p);
        if self.is_straight() || !(0.0..=1.0).contains(&foot) {
            return height(p);
        }
        let (mut low, mut high, mut s) = (0.0, 1.0, foot);
        for _ in 0..40 {
            let error = along(self.at(s)) - foot;
            if error.abs() < 1e-15 {
                break;
            }
            if error < 0.0 {
                low = s;
            } else {
                high = s;
            }
            let d = self.derivative(s);
            let next = s - error * length * length / (d.x * cx + d.y * cy);
            s = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        height(p) - height(self.at(s))
    }
}
