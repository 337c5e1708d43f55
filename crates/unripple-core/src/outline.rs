//! The outline of a sheet: its outer boundary, its holes, and the edge condition of each side.

use crate::{Point, Shape, Side};

/// The edge condition of one side of the sheet's boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edge {
    /// Clamped edge: no displacement, no slope.
    Clamped,
    /// Simply supported edge: no displacement, no bending moment.
    Supported,
    /// Free edge: no shear force, no bending moment.
    Free,
    /// Elastically restrained edge: springs along the side against displacement and against rotation.
    Elastic {
        /// Translational stiffness per length of edge, in N/m².
        lift: f64,
        /// Rotational stiffness per length of edge, in N·m/(m·rad).
        tilt: f64,
    },
}

impl Edge {
    /// Whether the edge can move up and down: true of free and of elastic edges.
    pub fn moves(self) -> bool {
        matches!(self, Self::Free | Self::Elastic { .. })
    }
}

/// The edge conditions of all sides of a closed boundary.
#[derive(Clone, Debug, PartialEq)]
pub enum Edges {
    /// The same condition on all sides.
    All(Edge),
    /// One condition per side, in the order of [`Shape::sides`].
    PerSide(Vec<Edge>),
}

impl Edges {
    /// The edge condition of side `i`, an index in the order of [`Shape::sides`]; clamped if the list is too short.
    pub fn of(&self, i: usize) -> Edge {
        match self {
            Self::All(edge) => *edge,
            Self::PerSide(list) => list.get(i).copied().unwrap_or(Edge::Clamped),
        }
    }
}

/// A hole in a sheet; a slit is a thin hole.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// The sides of the hole, in order, placed so that the lower-left corner of their bounding box is at the origin.
    pub sides: Vec<Side>,
    /// Position on the sheet of the lower-left corner of the hole's bounding box, in metres.
    pub at: Point,
    /// The edge conditions of the sides.
    pub edges: Edges,
}

impl Hole {
    /// A hole of a given shape with free edges; `at` (m) is the lower-left corner of its bounding box on the sheet.
    pub fn new(shape: &Shape, at: Point) -> Self {
        Self { sides: shape.sides(), at, edges: Edges::All(Edge::Free) }
    }

    /// A slit with round ends and free edges; `from` and `to` are the centres of its ends, `width` its width, all in metres.
    pub fn slit(from: Point, to: Point, width: f64) -> Self {
        let (length, radius) = (from.distance(to), width / 2.0);
        let angle = (to.y - from.y).atan2(to.x - from.x);
        let out = Point::new(radius * angle.sin(), -radius * angle.cos());
        let plus = |p: Point, s: f64| Point::new(p.x + s * out.x, p.y + s * out.y);
        let end = |centre, start| Side::Arc { centre, radius, start, sweep: std::f64::consts::PI };
        let quarter = std::f64::consts::FRAC_PI_2;
        let mut sides = vec![end(to, angle - quarter), end(from, angle + quarter)];
        if length > 0.0 {
            sides.insert(1, Side::Line { from: plus(to, -1.0), to: plus(from, -1.0) });
            sides.insert(0, Side::Line { from: plus(from, 1.0), to: plus(to, 1.0) });
        }
        let corner = Point::new(from.x.min(to.x) - radius, from.y.min(to.y) - radius);
        let sides = sides.into_iter().map(|s| s.moved(Point::new(-corner.x, -corner.y))).collect();
        Self { sides, at: corner, edges: Edges::All(Edge::Free) }
    }

    /// The sides of the hole in the coordinates of the sheet, anticlockwise around the hole.
    pub fn sides(&self) -> Vec<Side> {
        self.sides.iter().map(|side| side.moved(self.at)).collect()
    }

    fn shape(&self) -> Shape {
        Shape::Path(self.sides())
    }
}

/// A closed boundary curve of the sheet, oriented so that the sheet lies to its left.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// The sides in order, and the edge condition of each.
    pub sides: Vec<(Side, Edge)>,
}

/// The outline of a sheet: its outer boundary, the edge conditions there, and its holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// The curve of the outer boundary.
    pub shape: Shape,
    /// The edge condition of each side of the outer boundary.
    pub edges: Edges,
    /// The holes, which must not touch each other or the outer boundary.
    pub holes: Vec<Hole>,
}

impl Outline {
    /// An outline clamped all round, without holes.
    pub fn new(shape: Shape) -> Self {
        Self { shape, edges: Edges::All(Edge::Clamped), holes: Vec::new() }
    }

    /// The same outline with other edge conditions on its outer boundary.
    pub fn with_edges(mut self, edges: Edges) -> Self {
        self.edges = edges;
        self
    }

    /// The same outline with `hole` added to its holes.
    pub fn with_hole(mut self, hole: Hole) -> Self {
        self.holes.push(hole);
        self
    }

    /// All boundary curves, oriented so that the sheet lies to their left: the outer one anticlockwise,
    /// then those of the holes clockwise.
    pub fn loops(&self) -> Vec<Loop> {
        let held = |sides: Vec<Side>, edges: &Edges| {
            sides.into_iter().enumerate().map(|(i, side)| (side, edges.of(i))).collect::<Vec<_>>()
        };
        let outer = Loop { sides: held(self.shape.sides(), &self.edges) };
        let holes = self.holes.iter().map(|hole| {
            let turned = held(hole.sides(), &hole.edges).into_iter().rev();
            Loop { sides: turned.map(|(side, edge)| (side.reversed(), edge)).collect() }
        });
        std::iter::once(outer).chain(holes).collect()
    }

    /// Width and height of the bounding box, in metres.
    pub fn extent(&self) -> (f64, f64) {
        self.shape.extent()
    }

    /// Whether a point (in metres) lies on the sheet or on its boundary.
    pub fn contains(&self, p: Point) -> bool {
        let cut = |hole: &Hole| {
            let shape = hole.shape();
            // A point on a hole's rim is on the sheet, but for the rounding of coordinates.
            shape.contains(p) && shape.nearest_on_rim(p).distance(p) > 1e-12
        };
        self.shape.contains(p) && !self.holes.iter().any(cut)
    }

    /// The point of the sheet nearest to `p` (both in metres), for messages: `p` itself if it lies on the sheet,
    /// else the closest point on the sheet whose coordinates in millimetres have four decimals, as [`Point`]
    /// displays them.
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
        let rims = std::iter::once(self.shape.clone()).chain(self.holes.iter().map(Hole::shape));
        let on_rim = rims
            .map(|shape| shape.nearest_on_rim(p))
            .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
            .unwrap_or(p);
        // Of the 25 places of four decimals of a millimetre around, the nearest that is inside.
        let rounded = Point::new((on_rim.x * 1e7).round(), (on_rim.y * 1e7).round());
        (0..25)
            .map(|i| (rounded.x + f64::from(i % 5 - 2), rounded.y + f64::from(i / 5 - 2)))
            .map(|(x, y)| Point::from_mm(x / 1e4, y / 1e4))
            .filter(|q| self.contains(*q))
            .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
            .unwrap_or(on_rim)
    }

    /// Distance of a point from the nearest boundary, outer or of a hole, in metres.
    pub fn to_rim(&self, p: Point) -> f64 {
        let sides = self.loops().into_iter().flat_map(|rim| rim.sides);
        sides.map(|(side, _)| side.at(side.nearest(p)).distance(p)).fold(f64::INFINITY, f64::min)
    }

    /// Whether a disc, whose centre is a point of the sheet, lies wholly on the sheet; it may touch the boundary. Centre and
    /// radius are in metres.
    ///
    /// ```
    /// use unripple_core::{Outline, Point, Shape};
    ///
    /// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
    /// let at = Point::from_mm(12.0, 31.0);
    /// assert!(sheet.holds_disc(at, 0.012) && !sheet.holds_disc(at, 0.0121));
    /// ```
    pub fn holds_disc(&self, centre: Point, radius: f64) -> bool {
        // Rounding of millimetres in a file is no fault.
        self.to_rim(centre) >= radius * (1.0 - 1e-9)
    }

    /// Area S of the sheet without its holes, in m².
    pub fn area(&self) -> f64 {
        self.shape.area() - self.holes.iter().map(|hole| hole.shape().area()).sum::<f64>()
    }

    /// Total length P of the outer boundary and of those of the holes, in metres.
    pub fn perimeter(&self) -> f64 {
        self.shape.perimeter() + self.holes.iter().map(|hole| hole.shape().perimeter()).sum::<f64>()
    }

    /// Length of each side of the outer boundary, in metres, in the order of [`Shape::sides`].
    pub fn side_lengths(&self) -> Vec<f64> {
        self.shape.sides().iter().map(Side::length).collect()
    }

    /// The edge condition of side `i` of the outer boundary, an index in the order of [`Shape::sides`].
    pub fn edge(&self, i: usize) -> Edge {
        self.edges.of(i)
    }

    /// Total length of the free and elastic edges in metres, including those of holes.
    pub fn free_length(&self) -> f64 {
        let sides = self.loops().into_iter().flat_map(|rim| rim.sides);
        sides.filter(|(_, edge)| edge.moves()).map(|(side, _)| side.length()).sum()
    }

    /// Whether some edge, however short, is not free but resists displacement; if none does, the whole
    /// sheet can move as a rigid body.
    pub fn resists_displacement(&self) -> bool {
        let fixed = |edge: Edge| match edge {
            Edge::Clamped | Edge::Supported => true,
            Edge::Elastic { lift, .. } => lift > 0.0,
            Edge::Free => false,
        };
        self.loops().iter().any(|rim| rim.sides.iter().any(|(_, edge)| fixed(*edge)))
    }

    /// The outer boundary as a closed polygon for drawing, points in metres; arcs have `steps` pieces per
    /// full turn.
    pub fn rim(&self, steps: usize) -> Vec<Point> {
        self.shape.flattened(steps)
    }

    /// The boundaries of the holes as closed polygons for drawing, points in metres; arcs have `steps` pieces per full turn.
    pub fn hole_rims(&self, steps: usize) -> Vec<Vec<Point>> {
        self.holes.iter().map(|hole| hole.shape().flattened(steps)).collect()
    }
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

    #[test]
    fn holes_are_cut_out_and_keep_the_sheet_to_their_left() {
        let plate = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 })
            .with_hole(Hole::new(&Shape::Circle { radius: 0.02 }, Point::new(0.03, 0.03)))
            .with_hole(Hole::slit(Point::new(0.12, 0.02), Point::new(0.17, 0.07), 1e-3));
        let slit = 1e-3 * 0.05 * 2f64.sqrt() + std::f64::consts::PI * 0.25e-6;
        let area = 0.02 - std::f64::consts::PI * 4e-4 - slit;
        assert!((plate.area() / area - 1.0).abs() < 1e-12, "{} {area}", plate.area());
        for (inside, x, y) in [
            (false, 0.05, 0.05),
            (false, 0.05, 0.0699),
            (true, 0.05, 0.075),
            (false, 0.145, 0.045),
            (true, 0.145, 0.06),
        ] {
            assert_eq!(plate.contains(Point::new(x, y)), inside, "{x} {y}");
        }
        // The sheet lies a little to the left of every side.
        for (side, _) in plate.loops().into_iter().flat_map(|rim| rim.sides) {
            let (p, d) = (side.at(0.4), side.derivative(0.4));
            let step = 1e-5 / d.x.hypot(d.y);
            assert!(plate.contains(Point::new(p.x - step * d.y, p.y + step * d.x)), "{side:?}");
            assert!(!plate.contains(Point::new(p.x + step * d.y, p.y - step * d.x)), "{side:?}");
        }
    }
}
