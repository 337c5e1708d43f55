use crate::Point;
use std::f64::consts::PI;

/// The shape of a sheet's rim. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A rectangle with its lower-left corner at the origin.
    Rectangle {
        /// Along x.
        width: f64,
        /// Along y.
        height: f64,
    },
    /// A circle centred at (radius, radius).
    Circle {
        /// Its radius.
        radius: f64,
    },
    /// Two half circles joined by straight sides along x.
    Stadium {
        /// Length of each straight side.
        straight: f64,
        /// Radius of each end.
        radius: f64,
    },
    /// A simple closed polygon, anticlockwise, its bounding box cornered at the origin. Curves are flattened into one.
    Polygon(Vec<Point>),
}

/// How a side of the sheet is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Edge {
    /// No displacement, no slope.
    Clamped,
    /// No displacement, no moment.
    Supported,
    /// No force, no moment.
    Free,
}

/// How the whole rim is held.
#[derive(Clone, Debug, PartialEq)]
pub enum Edges {
    /// The same all round.
    All(Edge),
    /// One per side, from the bottom, anticlockwise.
    PerSide(Vec<Edge>),
}

/// A rim: its shape and how it is held.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// The shape.
    pub shape: Shape,
    /// The edges.
    pub edges: Edges,
}

impl Outline {
    /// An outline clamped all round.
    pub fn new(shape: Shape) -> Self {
        Self { shape, edges: Edges::All(Edge::Clamped) }
    }

    /// The same outline held otherwise.
    pub fn with_edges(mut self, edges: Edges) -> Self {
        self.edges = edges;
        self
    }

    /// Width and height of the bounding box, in metres.
    pub fn extent(&self) -> (f64, f64) {
        match &self.shape {
            Shape::Rectangle { width, height } => (*width, *height),
            Shape::Circle { radius } => (2.0 * radius, 2.0 * radius),
            Shape::Stadium { straight, radius } => (straight + 2.0 * radius, 2.0 * radius),
            Shape::Polygon(vertices) => {
                vertices.iter().fold((0.0, 0.0), |(w, h), p| (f64::max(w, p.x), f64::max(h, p.y)))
            }
        }
    }

    /// Whether a point lies inside or on the rim.
    pub fn contains(&self, p: Point) -> bool {
        if !p.is_finite() {
            return false;
        }
        match &self.shape {
            Shape::Rectangle { width, height } => {
                (0.0..=*width).contains(&p.x) && (0.0..=*height).contains(&p.y)
            }
            Shape::Circle { radius } => p.distance(Point::new(*radius, *radius)) <= *radius,
            Shape::Stadium { straight, radius } => {
                let x = p.x.clamp(*radius, radius + straight);
                p.distance(Point::new(x, *radius)) <= *radius
            }
            Shape::Polygon(vertices) => polygon_contains(vertices, p),
        }
    }

    /// The legal point nearest to `p`, to be told to people: `p` itself if it is inside, else the closest inside point
    /// whose coordinates in millimetres have four decimals, as [`Point`] displays them.
    ///
    /// ```
    /// use unripple_core::{Outline, Point, Shape};
    ///
    /// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
    /// assert_eq!(sheet.nearest(Point::from_mm(170.0, 90.0)), Point::from_mm(150.0, 90.0));
    /// ```
    pub fn nearest(&self, p: Point) -> Point {
        let (width, height) = self.extent();
        let finite = |x: f64, otherwise: f64| if x.is_finite() { x } else { otherwise };
        let p = Point::new(finite(p.x, width / 2.0), finite(p.y, height / 2.0));
        if self.contains(p) {
            return p;
        }
        let towards = |centre: Point, radius: f64| {
            let shrink = radius / p.distance(centre).max(f64::MIN_POSITIVE);
            Point::new(centre.x + (p.x - centre.x) * shrink, centre.y + (p.y - centre.y) * shrink)
        };
        let on_rim = match &self.shape {
            Shape::Rectangle { .. } => Point::new(p.x.clamp(0.0, width), p.y.clamp(0.0, height)),
            Shape::Circle { radius } => towards(Point::new(*radius, *radius), *radius),
            Shape::Stadium { straight, radius } => {
                towards(Point::new(p.x.clamp(*radius, radius + straight), *radius), *radius)
            }
            Shape::Polygon(vertices) => sides(vertices)
                .map(|(a, b)| foot(a, b, p))
                .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
                .unwrap_or(p),
        };
        let rounded = Point::new((on_rim.x * 1e7).round(), (on_rim.y * 1e7).round());
        (0..25)
            .map(|i| (rounded.x + f64::from(i % 5 - 2), rounded.y + f64::from(i / 5 - 2)))
            .map(|(x, y)| Point::from_mm(x / 1e4, y / 1e4))
            .filter(|q| self.contains(*q))
            .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
            .unwrap_or(on_rim)
    }

    /// Enclosed area S, in m².
    pub fn area(&self) -> f64 {
        match &self.shape {
            Shape::Rectangle { width, height } => width * height,
            Shape::Circle { radius } => PI * radius * radius,
            Shape::Stadium { straight, radius } => PI * radius * radius + 2.0 * straight * radius,
            Shape::Polygon(vertices) => {
                sides(vertices).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>().abs() / 2.0
            }
        }
    }

    /// Length of the rim P, in metres.
    pub fn perimeter(&self) -> f64 {
        match &self.shape {
            Shape::Rectangle { width, height } => 2.0 * (width + height),
            Shape::Circle { radius } => 2.0 * PI * radius,
            Shape::Stadium { straight, radius } => 2.0 * (PI * radius + straight),
            Shape::Polygon(vertices) => sides(vertices).map(|(a, b)| a.distance(b)).sum(),
        }
    }

    /// Lengths of the sides that edges are listed for: from the bottom, anticlockwise. Empty for round shapes.
    pub fn side_lengths(&self) -> Vec<f64> {
        match &self.shape {
            Shape::Rectangle { width, height } => vec![*width, *height, *width, *height],
            Shape::Circle { .. } | Shape::Stadium { .. } => Vec::new(),
            Shape::Polygon(vertices) => sides(vertices).map(|(a, b)| a.distance(b)).collect(),
        }
    }

    /// How side `i` is held, counted as in [`Outline::side_lengths`].
    pub fn edge(&self, i: usize) -> Edge {
        match &self.edges {
            Edges::All(edge) => *edge,
            Edges::PerSide(list) => list.get(i).copied().unwrap_or(Edge::Clamped),
        }
    }

    /// Length of the free part of the rim, in metres.
    pub fn free_length(&self) -> f64 {
        match &self.edges {
            Edges::All(Edge::Free) => self.perimeter(),
            Edges::All(_) => 0.0,
            Edges::PerSide(list) => self
                .side_lengths()
                .iter()
                .zip(list)
                .filter(|(_, edge)| **edge == Edge::Free)
                .map(|(length, _)| length)
                .sum(),
        }
    }

    /// The rim as a closed polygon, its curves in `steps` pieces per full turn; for drawing.
    pub fn rim(&self, steps: usize) -> Vec<Point> {
        let arc = |cx: f64, cy: f64, r: f64, from: f64, sweep: f64, n: usize| {
            (0..=n).map(move |i| {
                let a = from + sweep * i as f64 / n as f64;
                Point::new(cx + r * a.cos(), cy + r * a.sin())
            })
        };
        let half = (steps / 2).max(2);
        match &self.shape {
            Shape::Rectangle { width: w, height: h } => {
                vec![Point::new(0.0, 0.0), Point::new(*w, 0.0), Point::new(*w, *h), Point::new(0.0, *h)]
            }
            Shape::Circle { radius: r } => arc(*r, *r, *r, 0.0, 2.0 * PI, 2 * half).take(2 * half).collect(),
            Shape::Stadium { straight, radius: r } => arc(r + straight, *r, *r, -PI / 2.0, PI, half)
                .chain(arc(*r, *r, *r, PI / 2.0, PI, half))
                .collect(),
            Shape::Polygon(vertices) => vertices.clone(),
        }
    }
}

fn sides(vertices: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    let next = vertices.iter().cycle().skip(1);
    vertices.iter().zip(next).map(|(a, b)| (*a, *b))
}

/// The point of the side from `a` to `b` that is nearest to `p`.
fn foot(a: Point, b: Point, p: Point) -> Point {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let along = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
    let along = along.clamp(0.0, 1.0);
    Point::new(a.x + along * dx, a.y + along * dy)
}

fn polygon_contains(vertices: &[Point], p: Point) -> bool {
    let mut inside = false;
    for (a, b) in sides(vertices) {
        let along = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        let scale = a.distance(b).max(f64::MIN_POSITIVE);
        let within = (p.x - a.x) * (p.x - b.x) + (p.y - a.y) * (p.y - b.y) <= 0.0;
        if (along / scale).abs() <= 1e-12 && within {
            return true;
        }
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y) {
            inside = !inside;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_shapes_agree_with_their_polygons() {
        for shape in [Shape::Circle { radius: 0.07 }, Shape::Stadium { straight: 0.06, radius: 0.04 }] {
            let round = Outline::new(shape);
            let flat = Outline::new(Shape::Polygon(round.rim(20_000)));
            assert!((round.area() / flat.area() - 1.0).abs() < 1e-6);
            assert!((round.perimeter() / flat.perimeter() - 1.0).abs() < 1e-6);
            let (w, h) = round.extent();
            for i in 0..400 {
                let p = Point::new(w * (i % 20) as f64 / 19.3, h * (i / 20) as f64 / 19.3);
                assert_eq!(round.contains(p), flat.contains(p), "{p}");
            }
        }
    }

    #[test]
    fn the_nearest_point_can_be_typed_back() {
        let slanted = vec![Point::new(0.0, 0.0), Point::new(0.12, 0.0), Point::new(0.09, 0.08)];
        let shapes = [
            Shape::Rectangle { width: 0.15, height: 0.1 },
            Shape::Circle { radius: 0.07 },
            Shape::Stadium { straight: 0.06, radius: 0.04 },
            Shape::Polygon(slanted),
        ];
        for outline in shapes.map(Outline::new) {
            for i in 0..200 {
                let angle = f64::from(i) * 0.37;
                let p = Point::new(0.07 + 0.3 * angle.cos(), 0.04 + 0.3 * angle.sin());
                let legal = outline.nearest(p);
                let text = legal.to_string();
                let (x, y) = text.trim_start_matches('(').split_once(", ").unwrap();
                let y = y.split_once(')').unwrap().0;
                let typed = Point::from_mm(x.parse().unwrap(), y.parse().unwrap());
                assert!(outline.contains(typed), "{text}");
                let best = outline.rim(2000).iter().map(|q| q.distance(p)).fold(f64::MAX, f64::min);
                assert!(legal.distance(p) < best + 1e-6, "{text}: {best}");
            }
            assert!(outline.contains(outline.nearest(Point::new(f64::NAN, f64::INFINITY))));
        }
    }

    #[test]
    fn free_length_counts_only_free_sides() {
        let sheet = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 })
            .with_edges(Edges::PerSide(vec![Edge::Free, Edge::Clamped, Edge::Supported, Edge::Free]));
        assert!((sheet.free_length() - 0.3).abs() < 1e-12);
        assert_eq!(sheet.edge(2), Edge::Supported);
    }
}
