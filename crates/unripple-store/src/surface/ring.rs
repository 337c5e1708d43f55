//! Closed curves of a surface file; `unripple-core` says whether they cross themselves.

use super::bounds::Bounds;
use crate::decimal;
use unripple_core::plane::{self, Met};
use unripple_core::{Edge, Edges, Point, Shape, Side};

/// Largest number of sides of a closed curve: each is compared with those near it for crossings.
pub(super) const MOST_SIDES: usize = 4096;
/// How far from the origin the corner of the bounding box may lie, in metres.
pub(super) const CORNER: f64 = 1e-9;

/// A closed curve of a file, anticlockwise.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    /// Sides of the curve in metres, end to end.
    pub sides: Vec<Side>,
    /// How many sides each side of the file became, in the file's order.
    counts: Vec<usize>,
    /// Whether the file lists it clockwise.
    turned: bool,
}

/// The fault that was found, and what is expected instead.
pub(super) type Complaint = (String, String);

impl Ring {
    /// A curve of sides in the order of the file; `counts` has, for each side that the file lists, the
    /// number of sides that it became.
    pub fn new(sides: Vec<Side>, counts: Vec<usize>) -> Self {
        let turned = is_clockwise(&sides);
        let sides = if turned { sides.into_iter().rev().map(Side::reversed).collect() } else { sides };
        Self { sides, counts, turned }
    }

    /// A curve of sides in the order of the file, each of which is one side that the file lists.
    pub fn plain(sides: Vec<Side>) -> Self {
        let counts = vec![1; sides.len()];
        Self::new(sides, counts)
    }

    /// The exact bounding box of the curve, in metres.
    pub fn bounds(&self) -> Bounds {
        Bounds::of_sides(&self.sides)
    }

    /// Number of sides that the file lists for this curve.
    pub fn sides_of_file(&self) -> usize {
        self.counts.len()
    }

    /// Edge conditions of the curve's sides, from those of the sides that the file lists.
    pub fn edges(&self, list: &[Edge]) -> Edges {
        let each = list.iter().zip(&self.counts);
        let mut edges: Vec<Edge> = each.flat_map(|(edge, n)| std::iter::repeat_n(*edge, *n)).collect();
        if self.turned {
            edges.reverse();
        }
        Edges::PerSide(edges)
    }

    /// This ring moved so that the corner of its bounding box is at the origin, and where that corner was, in metres.
    pub fn cornered(mut self) -> (Self, Point) {
        let corner = self.bounds().least;
        let back = Point::new(-corner.x, -corner.y);
        self.sides = self.sides.into_iter().map(|side| side.moved(back)).collect();
        (self, corner)
    }

    /// The curve as a polygon if all sides are straight, otherwise as a path.
    pub fn shape(&self) -> Shape {
        let straight = self.sides.iter().all(Side::is_straight);
        let starts = || self.sides.iter().map(|side| side.at(0.0)).collect();
        if straight { Shape::Polygon(starts()) } else { Shape::Path(self.sides.clone()) }
    }

    /// What is wrong with the number of sides, the area or the course, if anything; `least` area is a share of the
    /// bounding box's longer side squared.
    pub fn complaint(&self, what: &str, least: f64) -> Option<Complaint> {
        let sides = self.sides.len();
        if sides > MOST_SIDES {
            return Some((format!("{sides} sides"), format!("at most {MOST_SIDES} sides")));
        }
        let area = Shape::Path(self.sides.clone()).area();
        let size = self.bounds().size();
        if area.is_nan() || area < least * size * size {
            return Some((format!("{what} without area"), format!("{what} that encloses something")));
        }
        self.crossing(what)
    }

    /// What is wrong with the course of the curve, crossings or gaps, if anything.
    pub fn crossing(&self, what: &str) -> Option<Complaint> {
        // As the file counts them.
        let count = self.sides.len();
        let starts = self.counts.iter().scan(0, |end, n| {
            *end += n;
            Some(*end)
        });
        let ends: Vec<usize> = starts.collect();
        let listed = |i: usize| {
            let i = if self.turned { count - 1 - i } else { i };
            ends.partition_point(|end| *end <= i)
        };
        let found = match plane::within(&self.sides)? {
            Met::Sides([i, j], at) => match (listed(i).min(listed(j)), listed(i).max(listed(j))) {
                (i, j) if i == j => format!("side {i} that crosses or touches itself at {}", place(at)),
                (i, j) => format!("sides {i} and {j} that cross or touch at {}", place(at)),
            },
            Met::TooMany => "sides that lie along each other in too many places to compare".into(),
        };
        Some((found, format!("{what} that does not meet itself")))
    }
}

/// Whether sides run clockwise, by the area of their polygon.
pub(super) fn is_clockwise(sides: &[Side]) -> bool {
    let points = Shape::Path(sides.to_vec()).flattened(96);
    let origin = points.first().copied().unwrap_or_default();
    let next = points.iter().cycle().skip(1);
    let doubled =
        |(a, b): (&Point, &Point)| (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
    points.iter().zip(next).map(doubled).sum::<f64>() < 0.0
}

/// What is wrong with the place of a curve that must be cornered at the origin, if anything.
pub(super) fn off_corner(bounds: &Bounds, what: &str, each: &str) -> Option<Complaint> {
    let corner = bounds.least;
    let (x, y) = (millimetres(corner.x), millimetres(corner.y));
    (corner.x.abs() > CORNER || corner.y.abs() > CORNER).then(|| {
        let expected =
            format!("{what} whose bounding box starts at [0, 0]: take that much from every {each}");
        (format!("{what} whose bounding box starts at [{x}, {y}] mm"), expected)
    })
}

/// Metres as millimetres to the nanometre, for messages.
pub(super) fn millimetres(metres: f64) -> String {
    decimal::text((metres * 1e9).round() / 1e6, 0)
}

/// A place as a file has it, for messages.
pub(super) fn place(at: Point) -> String {
    format!("[{}, {}] mm", millimetres(at.x), millimetres(at.y))
}
