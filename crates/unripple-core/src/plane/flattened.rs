//! Counts the corners of simply supported polygons with many straight sides, which most often stand for a
//! curve.

use super::rims::Rims;
use crate::{Edge, Outline};
use std::f64::consts::PI;

/// Largest turn at a corner, in radians (20°), that is taken for a corner of a curve drawn as a polygon.
/// With twice this value, an octagon would be taken for a curve.
const NEARLY: f64 = 0.35;
/// Corners that turn by less than this angle, in radians, are rounding errors of coordinates on one
/// straight line.
const STRAIGHT: f64 = 1e-4;
/// Least number of such corners on one boundary curve for which the curve counts as drawn as a polygon: a
/// true polygon has fewer.
const MANY: usize = 8;

impl Outline {
    /// The number of corners that seem to come from a curve drawn as a polygon: corners between simply
    /// supported straight sides that turn by less than 20°, on boundary curves with at least eight of them.
    /// 0 for an invalid outline.
    ///
    /// A plate supported along a polygon stays stiffer than one supported along the curve that the polygon approaches, however many
    /// sides it has (Babuška and Pitkäranta, *SIAM J. Math. Anal.* 21, 551, 1990).
    ///
    /// ```
    /// use unripple_core::{Edge, Edges, Outline, Point, Shape};
    ///
    /// let corner = |i: u32| Point::new(1.0 + (f64::from(i) / 4.0).cos(), 1.0 + (f64::from(i) / 4.0).sin());
    /// let polygon = Outline::new(Shape::Polygon((0..25).map(corner).collect()));
    /// assert_eq!(polygon.flattened_corners(), 0);
    /// assert_eq!(polygon.with_edges(Edges::All(Edge::Supported)).flattened_corners(), 25);
    /// ```
    pub fn flattened_corners(&self) -> usize {
        let Ok(rims) = Rims::new(self) else { return 0 };
        let flattened = |side: usize| {
            let meeting = [rims.previous(side), side].map(|i| rims.sides[i]);
            let turn = (rims.angles[side] - PI).abs();
            let supported =
                |(curve, edge): &(crate::Side, Edge)| curve.is_straight() && *edge == Edge::Supported;
            meeting.iter().all(supported) && (STRAIGHT..NEARLY).contains(&turn)
        };
        let of_rim = rims.loops.iter().map(|rim| rim.clone().filter(|side| flattened(*side)).count());
        of_rim.filter(|count| *count >= MANY).sum()
    }
}
