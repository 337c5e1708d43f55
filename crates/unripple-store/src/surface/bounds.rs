//! Bounding box of a rim.

use unripple_core::{Point, Side};

/// Lower-left and upper-right corner of what was added so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    /// Lower-left corner of the box, in metres.
    pub least: Point,
    /// Upper-right corner of the box, in metres.
    pub greatest: Point,
}

impl Bounds {
    const EMPTY: Self =
        Self { least: Point::new(f64::MAX, f64::MAX), greatest: Point::new(f64::MIN, f64::MIN) };

    /// The exact bounding box of sides.
    pub fn of_sides(sides: &[Side]) -> Self {
        sides.iter().flat_map(extremes).fold(Self::EMPTY, Self::with)
    }

    /// The bounding box of points, in metres.
    pub fn of_points(points: &[Point]) -> Self {
        points.iter().copied().fold(Self::EMPTY, Self::with)
    }

    fn with(self, p: Point) -> Self {
        let (l, g) = (self.least, self.greatest);
        Self {
            least: Point::new(l.x.min(p.x), l.y.min(p.y)),
            greatest: Point::new(g.x.max(p.x), g.y.max(p.y)),
        }
    }

    /// The longer side of the box, in metres.
    pub fn size(&self) -> f64 {
        (self.greatest.x - self.least.x).max(self.greatest.y - self.least.y)
    }

    /// Whether a point lies in the box, or outside it by less than `margin`, all in metres.
    pub fn hold(&self, p: Point, margin: f64) -> bool {
        let between = |v: f64, low: f64, high: f64| (low - margin..=high + margin).contains(&v);
        between(p.x, self.least.x, self.greatest.x) && between(p.y, self.least.y, self.greatest.y)
    }
}

/// The ends of a side and the points where it runs along an axis.
fn extremes(side: &Side) -> Vec<Point> {
    let mut points = vec![side.at(0.0), side.at(1.0)];
    match *side {
        Side::Line { .. } => {}
        Side::Arc { centre, radius, start, sweep } => {
            let (low, high) = (start.min(start + sweep), start.max(start + sweep));
            let quarter = std::f64::consts::FRAC_PI_2;
            let [first, last] = [(low / quarter).ceil(), (high / quarter).floor()];
            // More than a whole turn shows nothing new.
            for i in 0..5 {
                let turn = first + f64::from(i);
                if turn <= last {
                    let (x, y) =
                        [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][turn.rem_euclid(4.0) as usize % 4];
                    points.push(Point::new(centre.x + radius * x, centre.y + radius * y));
                }
            }
        }
        Side::Cubic([a, b, c, d]) => {
            for coordinate in [|p: Point| p.x, |p: Point| p.y] {
                let [a, b, c, d] = [a, b, c, d].map(coordinate);
                let slope = [b - a, 2.0 * (a - 2.0 * b + c), 3.0 * (b - c) + d - a];
                let level = kurbo::common::solve_quadratic(slope[0], slope[1], slope[2]);
                let inner = level.into_iter().filter(|t| (0.0..=1.0).contains(t));
                points.extend(inner.map(|t| side.at(t)));
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Bounds against many points of each side, and reached by them.
    #[test]
    fn boxes_fit_tightly() {
        let p = Point::new;
        for side in [
            Side::Line { from: p(0.3, 0.1), to: p(-0.2, 0.4) },
            Side::Arc { centre: p(0.1, 0.2), radius: 0.3, start: -PI / 2.0, sweep: 2.0 * PI },
            Side::Arc { centre: p(0.1, 0.2), radius: 0.3, start: 3.0, sweep: -2.5 },
            Side::Arc { centre: p(0.1, 0.2), radius: 0.3, start: 10.0, sweep: 0.3 },
            Side::Cubic([p(0.0, 0.0), p(0.9, 0.4), p(-0.8, 0.5), p(0.2, -0.1)]),
            Side::Cubic([p(0.0, 0.0), p(0.1, 0.4), p(0.2, 0.4), p(0.3, 0.0)]),
        ] {
            let bounds = Bounds::of_sides(&[side]);
            let many: Vec<Point> = (0..=20_000).map(|i| side.at(f64::from(i) / 2e4)).collect();
            let seen = Bounds::of_points(&many);
            assert!(many.iter().all(|q| bounds.hold(*q, 1e-15)), "{side:?}");
            assert!(bounds.least.distance(seen.least) < 1e-8, "{side:?}");
            assert!(bounds.greatest.distance(seen.greatest) < 1e-8, "{side:?}");
        }
    }

    #[test]
    fn a_circle_starts_at_zero_exactly() {
        let circle = unripple_core::Shape::Circle { radius: 0.0701 };
        assert_eq!(Bounds::of_sides(&circle.sides()).least, Point::new(0.0, 0.0));
    }
}
