//! One smooth side of a boundary curve: a line, an arc or a Bézier curve.

use crate::Point;
use std::f64::consts::TAU;

/// One smooth side of a boundary curve, described by a parameter from 0 (start) to 1 (end). Sides of a
/// [`Shape`](crate::Shape) have the inside of the shape to their left; sides of a [`Loop`](crate::Loop)
/// have the sheet to their left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// A straight line.
    Line {
        /// Start point, in metres.
        from: Point,
        /// End point, in metres.
        to: Point,
    },
    /// An arc of a circle.
    Arc {
        /// The centre, in metres.
        centre: Point,
        /// The radius, in metres.
        radius: f64,
        /// Angle of the start point seen from the centre, in radians anticlockwise from x.
        start: f64,
        /// Angle from start to end, in radians, positive anticlockwise.
        sweep: f64,
    },
    /// A cubic Bézier curve, by its four control points in metres.
    Cubic([Point; 4]),
}

/// Number of intervals of Gauss quadrature for the length of a cubic curve. Each is exact if |dr/dt| is a polynomial of
/// degree 7. Twice as many cost twice the evaluations and lower the error about 256-fold.
const PIECES: usize = 8;

impl Side {
    /// The point at parameter `t` (0 to 1), in metres.
    pub fn at(&self, t: f64) -> Point {
        match *self {
            Self::Line { from, to } => Point::new(from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t),
            Self::Arc { centre, radius, start, sweep } => {
                let a = start + sweep * t;
                Point::new(centre.x + radius * a.cos(), centre.y + radius * a.sin())
            }
            Self::Cubic(p) => {
                let s = 1.0 - t;
                combine(&p, [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t])
            }
        }
    }

    /// The first derivative dr/dt of the point with respect to the parameter, in metres, at `t` (0 to 1).
    pub fn derivative(&self, t: f64) -> Point {
        match *self {
            Self::Line { from, to } => Point::new(to.x - from.x, to.y - from.y),
            Self::Arc { radius, start, sweep, .. } => {
                let a = start + sweep * t;
                Point::new(-radius * sweep * a.sin(), radius * sweep * a.cos())
            }
            Self::Cubic(p) => {
                let s = 1.0 - t;
                let (a, b, c) = (3.0 * s * s, 6.0 * s * t, 3.0 * t * t);
                combine(&p, [-a, a - b, b - c, c])
            }
        }
    }

    /// The second derivative d²r/dt² of the point with respect to the parameter, in metres, at `t` (0 to 1).
    pub fn second_derivative(&self, t: f64) -> Point {
        match *self {
            Self::Line { .. } => Point::new(0.0, 0.0),
            Self::Arc { radius, start, sweep, .. } => {
                let a = start + sweep * t;
                Point::new(-radius * sweep * sweep * a.cos(), -radius * sweep * sweep * a.sin())
            }
            Self::Cubic(p) => combine(&p, [6.0 - 6.0 * t, 18.0 * t - 12.0, 6.0 - 18.0 * t, 6.0 * t]),
        }
    }

    /// Curvature at parameter `t` (0 to 1), in 1/m: positive where the curve turns left.
    pub fn curvature(&self, t: f64) -> f64 {
        let (d, dd) = (self.derivative(t), self.second_derivative(t));
        (d.x * dd.y - d.y * dd.x) / d.x.hypot(d.y).powi(3).max(f64::MIN_POSITIVE)
    }

    /// Arc length from the start to parameter `t` (0 to 1), in metres.
    pub fn length_to(&self, t: f64) -> f64 {
        match *self {
            Self::Line { from, to } => from.distance(to) * t,
            Self::Arc { radius, sweep, .. } => radius * sweep.abs() * t,
            Self::Cubic(_) => {
                let speed = |s: f64| {
                    let d = self.derivative(s);
                    d.x.hypot(d.y)
                };
                let step = t / PIECES as f64;
                (0..PIECES).map(|i| gauss(speed, i as f64 * step, step)).sum()
            }
        }
    }

    /// Length of the whole side, in metres.
    pub fn length(&self) -> f64 {
        self.length_to(1.0)
    }

    /// Whether the side is a straight line.
    pub fn is_straight(&self) -> bool {
        matches!(self, Self::Line { .. })
    }

    /// The same side with start and end exchanged.
    pub fn reversed(self) -> Self {
        match self {
            Self::Line { from, to } => Self::Line { from: to, to: from },
            Self::Arc { centre, radius, start, sweep } => {
                Self::Arc { centre, radius, start: (start + sweep) % TAU, sweep: -sweep }
            }
            Self::Cubic([a, b, c, d]) => Self::Cubic([d, c, b, a]),
        }
    }

    /// The same side translated by a vector (m).
    pub fn moved(self, by: Point) -> Self {
        let shift = |p: Point| Point::new(p.x + by.x, p.y + by.y);
        match self {
            Self::Line { from, to } => Self::Line { from: shift(from), to: shift(to) },
            Self::Arc { centre, radius, start, sweep } => {
                Self::Arc { centre: shift(centre), radius, start, sweep }
            }
            Self::Cubic(p) => Self::Cubic(p.map(shift)),
        }
    }

    /// The parameter (0 to 1) of the point of the side nearest to `p` (m).
    pub fn nearest(&self, p: Point) -> f64 {
        match *self {
            Self::Line { from, to } => {
                let (dx, dy) = (to.x - from.x, to.y - from.y);
                let along = (p.x - from.x) * dx + (p.y - from.y) * dy;
                (along / (dx * dx + dy * dy).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
            }
            Self::Arc { centre, start, sweep, .. } => {
                let turn = ((p.y - centre.y).atan2(p.x - centre.x) - start) * sweep.signum();
                // Beyond both ends, the nearer end.
                let (turn, sweep) = (turn.rem_euclid(TAU), sweep.abs());
                let t = if turn - sweep > 0.5 * (TAU - sweep) { 0.0 } else { turn / sweep };
                t.min(1.0)
            }
            Self::Cubic(_) => self.nearest_on_curve(p),
        }
    }

    /// The parameter of the point nearest to `p`: a search on a lattice of parameters, then Newton's method
    /// on the squared distance, limited to the interval between the neighbouring lattice points.
    fn nearest_on_curve(&self, p: Point) -> f64 {
        // Fine enough that Newton's method starts at the nearest of a cubic's few minima.
        const LATTICE: usize = 32;
        let from = |t: f64| self.at(t).distance(p);
        let best = (0..=LATTICE)
            .map(|i| i as f64 / LATTICE as f64)
            .min_by(|a, b| from(*a).total_cmp(&from(*b)))
            .unwrap_or(0.0);
        let (low, high) = ((best - 1.0 / LATTICE as f64).max(0.0), (best + 1.0 / LATTICE as f64).min(1.0));
        let mut t = best;
        for _ in 0..20 {
            let (q, d, dd) = (self.at(t), self.derivative(t), self.second_derivative(t));
            let (ex, ey) = (q.x - p.x, q.y - p.y);
            let slope = ex * d.x + ey * d.y;
            let bend = d.x * d.x + d.y * d.y + ex * dd.x + ey * dd.y;
            if bend <= 0.0 {
                break;
            }
            let next = (t - slope / bend).clamp(low, high);
            if (next - t).abs() < 1e-15 {
                break;
            }
            t = next;
        }
        if from(t) <= from(best) { t } else { best }
    }

    /// Twice the area between the side and the origin, in m², positive anticlockwise: ∫ x dy - y dx.
    pub(crate) fn doubled_area(&self) -> f64 {
        match *self {
            Self::Line { from, to } => from.x * to.y - to.x * from.y,
            Self::Arc { centre, radius, start, sweep } => {
                let (a, b) = (start, start + sweep);
                radius * radius * sweep
                    + radius * (centre.x * (b.sin() - a.sin()) - centre.y * (b.cos() - a.cos()))
            }
            Self::Cubic(_) => {
                let swept = |t: f64| {
                    let (q, d) = (self.at(t), self.derivative(t));
                    q.x * d.y - q.y * d.x
                };
                gauss(swept, 0.0, 1.0)
            }
        }
    }
}

fn combine(points: &[Point; 4], weights: [f64; 4]) -> Point {
    let sum = |f: fn(&Point) -> f64| points.iter().zip(weights).map(|(p, w)| f(p) * w).sum();
    Point::new(sum(|p| p.x), sum(|p| p.y))
}

/// The integral of `f` from `from` over `width`, in the units of both, by Gauss-Legendre quadrature of four
/// points.
pub(crate) fn gauss(f: impl Fn(f64) -> f64, from: f64, width: f64) -> f64 {
    // Nodes and weights on -1 to 1 (Abramowitz and Stegun, table 25.4), exact to degree 7.
    const RULE: [(f64, f64); 2] = [
        (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
    ];
    let middle = from + 0.5 * width;
    let pair = |(x, w): (f64, f64)| w * (f(middle - 0.5 * width * x) + f(middle + 0.5 * width * x));
    0.5 * width * RULE.into_iter().map(pair).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn sides() -> Vec<Side> {
        let p = Point::new;
        vec![
            Side::Line { from: p(0.1, 0.2), to: p(0.4, -0.1) },
            Side::Arc { centre: p(0.2, 0.1), radius: 0.3, start: 1.0, sweep: 2.0 },
            Side::Arc { centre: p(0.2, 0.1), radius: 0.3, start: -2.0, sweep: -1.2 },
            Side::Cubic([p(0.0, 0.0), p(0.1, 0.3), p(0.4, 0.2), p(0.5, -0.1)]),
        ]
    }

    #[test]
    fn derivatives_are_slopes() {
        for side in sides() {
            for t in [0.0, 0.3, 1.0] {
                let d = 1e-6;
                let slope = (side.at(t + d).x - side.at(t - d).x) / (2.0 * d);
                assert!((slope - side.derivative(t).x).abs() < 1e-8);
                let bend = (side.derivative(t + d).y - side.derivative(t - d).y) / (2.0 * d);
                assert!((bend - side.second_derivative(t).y).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn a_quarter_turn_to_the_left_curves_positively() {
        let arc = Side::Arc { centre: Point::new(0.0, 0.0), radius: 0.5, start: 0.0, sweep: FRAC_PI_2 };
        assert!((arc.curvature(0.4) - 2.0).abs() < 1e-12);
        assert!((arc.reversed().curvature(0.4) + 2.0).abs() < 1e-12);
        assert!((arc.length() - PI / 4.0).abs() < 1e-12);
        assert!(arc.reversed().at(0.0).distance(arc.at(1.0)) < 1e-15);
    }

    #[test]
    fn nothing_of_a_side_is_nearer_than_the_nearest() {
        for side in sides() {
            for i in 0..60 {
                let p = Point::new(0.6 * (f64::from(i) * 0.7).cos(), 0.6 * (f64::from(i) * 1.3).sin());
                let found = side.at(side.nearest(p)).distance(p);
                let best = (0..=2000).map(|j| side.at(f64::from(j) / 2000.0).distance(p)).fold(9.0, f64::min);
                assert!(found <= best + 1e-9, "{side:?} {p}: {found} {best}");
            }
        }
    }

    #[test]
    fn a_cubic_is_as_long_as_its_chords() {
        let side = sides()[3];
        let point = |i: u32| side.at(f64::from(i) / 4000.0);
        let chords: f64 = (0..4000).map(|i| point(i).distance(point(i + 1))).sum();
        assert!((side.length() / chords - 1.0).abs() < 1e-7);
    }
}
