//! Regions of the surface in which effects act.

use crate::error::{counted, place, within};
use crate::{EffectsError, limits};
use unripple_core::Point;

/// The region of the surface in which an effect acts.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// The whole sheet, wherever it is touched.
    Everywhere,
    /// A rectangle with sides along the axes.
    Rectangle {
        /// Its lower-left corner, in m.
        corner: Point,
        /// Its length along x, in m.
        width: f64,
        /// Its length along y, in m.
        height: f64,
    },
    /// A disc, given by centre and radius.
    Circle {
        /// Its centre, in m.
        centre: Point,
        /// Its radius, in m.
        radius: f64,
    },
    /// A polygon, given by its corners in m, clockwise or anticlockwise; if its sides cross, the even-odd
    /// rule decides what is inside.
    Polygon(Vec<Point>),
}

impl Region {
    /// Whether a place (m) lies in the region.
    ///
    /// ```
    /// use unripple_core::Point;
    /// use unripple_effects::Region;
    ///
    /// let disc = Region::Circle { centre: Point::from_mm(50.0, 50.0), radius: 0.01 };
    /// assert!(disc.contains(Point::from_mm(55.0, 50.0)) && !disc.contains(Point::from_mm(61.0, 50.0)));
    /// ```
    pub fn contains(&self, p: Point) -> bool {
        match self {
            Self::Everywhere => true,
            Self::Rectangle { corner, width, height } => {
                (0.0..=*width).contains(&(p.x - corner.x)) && (0.0..=*height).contains(&(p.y - corner.y))
            }
            Self::Circle { centre, radius } => p.distance(*centre) <= *radius,
            Self::Polygon(corners) => {
                let next = corners.iter().cycle().skip(1);
                let crossed = |(a, b): &(&Point, &Point)| {
                    (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)
                };
                corners.iter().zip(next).filter(crossed).count() % 2 == 1
            }
        }
    }

    /// The crossings of the straight path between two places (m) with the region's border, as shares of the path's length (0 to 1),
    /// ascending.
    pub fn crossings(&self, from: Point, to: Point) -> Vec<f64> {
        let mut found: Vec<f64> = match self {
            Self::Everywhere => Vec::new(),
            Self::Rectangle { corner: c, width, height } => {
                let (x, y) = (c.x + width, c.y + height);
                let corners = [*c, Point::new(x, c.y), Point::new(x, y), Point::new(c.x, y)];
                ring(&corners, from, to)
            }
            Self::Circle { centre, radius } => circle(*centre, *radius, from, to),
            Self::Polygon(corners) => ring(corners, from, to),
        };
        found.sort_by(f64::total_cmp);
        found
    }

    /// Refuses a region whose values are out of range, or that has too few or too many corners.
    pub(crate) fn check(&self) -> Result<(), EffectsError> {
        match self {
            Self::Everywhere => Ok(()),
            Self::Rectangle { corner, width, height } => {
                place("corner of a region", *corner)?;
                within("width of a region", *width, limits::LENGTH)?;
                within("height of a region", *height, limits::LENGTH)
            }
            Self::Circle { centre, radius } => {
                place("centre of a region", *centre)?;
                within("radius of a region", *radius, limits::LENGTH)
            }
            Self::Polygon(corners) => {
                counted("corners of a region", corners.len(), 3, limits::MOST_CORNERS)?;
                corners.iter().try_for_each(|corner| place("corner of a region", *corner))
            }
        }
    }
}

/// The crossing of the straight path between two places (m) with the segment between two points (m), as a share of
/// the path's length.
pub(crate) fn crossing((a, b): (Point, Point), from: Point, to: Point) -> Option<f64> {
    let side = |p: Point| (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    let (before, after) = (side(from), side(to));
    // A place on the line counts as left of it, so that a path that ends there and goes on crosses once.
    if (before >= 0.0) == (after >= 0.0) {
        return None;
    }
    let share = before / (before - after);
    let met = lerp(from, to, share);
    let along = (met.x - a.x) * (b.x - a.x) + (met.y - a.y) * (b.y - a.y);
    let length = (b.x - a.x).powi(2) + (b.y - a.y).powi(2);
    (0.0..length).contains(&along).then_some(share)
}

/// Linear interpolation: the point at a share (0 to 1) of the path from one place to another, in m.
pub(crate) fn lerp(from: Point, to: Point, share: f64) -> Point {
    Point::new(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y))
}

fn ring(corners: &[Point], from: Point, to: Point) -> Vec<f64> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).filter_map(|(a, b)| crossing((*a, *b), from, to)).collect()
}

/// The crossings of a straight path with a circle, as shares of the path's length.
fn circle(centre: Point, radius: f64, from: Point, to: Point) -> Vec<f64> {
    let (d, f) = ((to.x - from.x, to.y - from.y), (from.x - centre.x, from.y - centre.y));
    let (a, b) = (d.0 * d.0 + d.1 * d.1, f.0 * d.0 + f.1 * d.1);
    let c = f.0 * f.0 + f.1 * f.1 - radius * radius;
    let root = (b * b - a * c).sqrt();
    // If the line misses the circle, the root is not a number and neither share passes the filter.
    [(-b - root) / a, (-b + root) / a].into_iter().filter(|s| *s > 0.0 && *s <= 1.0).collect()
}
