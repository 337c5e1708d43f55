//! Closed curves that bound outlines and holes: rectangle, circle, stadium, polygon, path.

use crate::{Point, Side};
use std::f64::consts::PI;

/// Number of straight pieces by which a curved side of a path is approximated, for drawing and for the test
/// whether a point near a corner is inside. With twice as many, the distance between curve and pieces is a
/// fourth.
const FLAT: usize = 24;

/// A closed curve whose bounding box has its lower-left corner at the origin. Lengths and coordinates are in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A rectangle with its lower-left corner at the origin.
    Rectangle {
        /// Length along x.
        width: f64,
        /// Length along y.
        height: f64,
    },
    /// A circle centred at (radius, radius).
    Circle {
        /// Radius of the circle.
        radius: f64,
    },
    /// Two half circles joined by straight sides along x.
    Stadium {
        /// Length of each straight side.
        straight: f64,
        /// Radius of each end.
        radius: f64,
    },
    /// A simple closed polygon, anticlockwise.
    Polygon(Vec<Point>),
    /// Straight or curved sides joined end to end, anticlockwise.
    Path(Vec<Side>),
}

impl Shape {
    /// The sides in order, anticlockwise. The list begins with the bottom side of a rectangle or stadium,
    /// and with the first vertex or side of a polygon or path; a circle is one side that begins at its
    /// lowest point. Straight sides of length 0 in a stadium are left out.
    pub fn sides(&self) -> Vec<Side> {
        let p = Point::new;
        let line = |from, to| Side::Line { from, to };
        match self {
            Self::Rectangle { width: w, height: h } => vec![
                line(p(0.0, 0.0), p(*w, 0.0)),
                line(p(*w, 0.0), p(*w, *h)),
                line(p(*w, *h), p(0.0, *h)),
                line(p(0.0, *h), p(0.0, 0.0)),
            ],
            Self::Circle { radius: r } => {
                vec![Side::Arc { centre: p(*r, *r), radius: *r, start: -PI / 2.0, sweep: 2.0 * PI }]
            }
            Self::Stadium { straight: s, radius: r } => {
                let end = |x, start| Side::Arc { centre: p(x, *r), radius: *r, start, sweep: PI };
                let (bottom, top) =
                    (line(p(*r, 0.0), p(r + s, 0.0)), line(p(r + s, 2.0 * r), p(*r, 2.0 * r)));
                let round = [bottom, end(r + s, -PI / 2.0), top, end(*r, PI / 2.0)];
                round.into_iter().filter(|side| side.length() > 0.0).collect()
            }
            Self::Polygon(vertices) => {
                let next = vertices.iter().cycle().skip(1);
                vertices.iter().zip(next).map(|(a, b)| line(*a, *b)).collect()
            }
            Self::Path(sides) => sides.clone(),
        }
    }

    /// Name of the kind of shape, for people: "a rectangle".
    pub fn name(&self) -> &'static str {
        match self {
            Self::Rectangle { .. } => "a rectangle",
            Self::Circle { .. } => "a circle",
            Self::Stadium { .. } => "a stadium",
            Self::Polygon(_) => "a polygon",
            Self::Path(_) => "a path",
        }
    }

    /// Width and height of the bounding box, in metres.
    pub fn extent(&self) -> (f64, f64) {
        let reach = |points: &mut dyn Iterator<Item = Point>| {
            points.fold((0.0, 0.0), |(w, h), p| (f64::max(w, p.x), f64::max(h, p.y)))
        };
        match self {
            Self::Rectangle { width, height } => (*width, *height),
            Self::Circle { radius } => (2.0 * radius, 2.0 * radius),
            Self::Stadium { straight, radius } => (straight + 2.0 * radius, 2.0 * radius),
            Self::Polygon(vertices) => reach(&mut vertices.iter().copied()),
            Self::Path(sides) => {
                let points = sides.iter().flat_map(|s| (0..=64).map(|i| s.at(f64::from(i) / 64.0)));
                reach(&mut points.into_iter())
            }
        }
    }

    /// Whether a point (m) lies inside the curve or on it.
    pub fn contains(&self, p: Point) -> bool {
        if !p.is_finite() {
            return false;
        }
        match self {
            Self::Rectangle { width, height } => {
                (0.0..=*width).contains(&p.x) && (0.0..=*height).contains(&p.y)
            }
            Self::Circle { radius } => p.distance(Point::new(*radius, *radius)) <= *radius,
            Self::Stadium { straight, radius } => {
                let x = p.x.clamp(*radius, radius + straight);
                p.distance(Point::new(x, *radius)) <= *radius
            }
            Self::Polygon(vertices) => polygon_contains(vertices, p),
            Self::Path(sides) => path_contains(sides, p),
        }
    }

    /// The point of the curve nearest to `p`, both in metres.
    pub fn nearest_on_rim(&self, p: Point) -> Point {
        self.sides()
            .iter()
            .map(|side| side.at(side.nearest(p)))
            .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
            .unwrap_or(p)
    }

    /// Enclosed area, in m².
    pub fn area(&self) -> f64 {
        match self {
            Self::Rectangle { width, height } => width * height,
            Self::Circle { radius } => PI * radius * radius,
            Self::Stadium { straight, radius } => PI * radius * radius + 2.0 * straight * radius,
            Self::Polygon(_) | Self::Path(_) => {
                self.sides().iter().map(Side::doubled_area).sum::<f64>().abs() / 2.0
            }
        }
    }

    /// Length of the curve, in metres.
    pub fn perimeter(&self) -> f64 {
        match self {
            Self::Rectangle { width, height } => 2.0 * (width + height),
            Self::Circle { radius } => 2.0 * PI * radius,
            Self::Stadium { straight, radius } => 2.0 * (PI * radius + straight),
            Self::Polygon(_) | Self::Path(_) => self.sides().iter().map(Side::length).sum(),
        }
    }

    /// The curve as a closed polygon for drawing, points in metres: arcs are cut into `steps` pieces per full turn (at least
    /// 2 for each arc), Bézier sides into 24 pieces.
    pub fn flattened(&self, steps: usize) -> Vec<Point> {
        let pieces = |side: &Side| match side {
            Side::Line { .. } => 1,
            Side::Arc { sweep, .. } => ((steps as f64 * sweep.abs() / (2.0 * PI)).round() as usize).max(2),
            Side::Cubic(_) => FLAT,
        };
        let cut = |side: &Side| {
            let (side, n) = (*side, pieces(side));
            (0..n).map(move |i| side.at(i as f64 / n as f64))
        };
        self.sides().iter().flat_map(cut).collect()
    }
}

/// A point nearer to a side than this, in metres, counts as lying on it: some thousand times the rounding error of
/// coordinates of a metre, and a hundred-thousandth of the last decimal (0.1 µm) that points are written with.
const ON: f64 = 1e-12;

/// Whether a polygon holds a point, by counting the sides that a ray to the right crosses; sides count as
/// inside.
fn polygon_contains(vertices: &[Point], p: Point) -> bool {
    let next = vertices.iter().cycle().skip(1);
    let mut inside = false;
    for (a, b) in vertices.iter().zip(next) {
        let along = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        let scale = a.distance(*b).max(f64::MIN_POSITIVE);
        let within = (p.x - a.x) * (p.x - b.x) + (p.y - a.y) * (p.y - b.y) <= 0.0;
        if (along / scale).abs() <= ON && within {
            return true;
        }
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y) {
            inside = !inside;
        }
    }
    inside
}

/// Whether a path holds a point. If the nearest point of the path is within a side, the side's tangent there decides; if it is a
/// corner, the polygon through the corners and points of curved sides does.
fn path_contains(sides: &[Side], p: Point) -> bool {
    let nearest = sides
        .iter()
        .map(|side| {
            let t = side.nearest(p);
            (side, t, side.at(t))
        })
        .min_by(|a, b| a.2.distance(p).total_cmp(&b.2.distance(p)));
    let Some((side, t, q)) = nearest else { return false };
    if q.distance(p) <= ON {
        return true;
    }
    if t > 0.0 && t < 1.0 {
        let d = side.derivative(t);
        return d.x * (p.y - q.y) - d.y * (p.x - q.x) > 0.0;
    }
    let flat: Vec<Point> = sides
        .iter()
        .flat_map(|s| {
            let n = if s.is_straight() { 1 } else { FLAT };
            (0..n).map(move |i| s.at(i as f64 / n as f64))
        })
        .collect();
    polygon_contains(&flat, p)
}
