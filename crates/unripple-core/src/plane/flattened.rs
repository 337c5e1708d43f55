//! Rims of many supported straight sides, which are most often a curve that was flattened.

use super::rims::Rims;
use crate::{Edge, Outline};
use std::f64::consts::PI;

/// Corners this near to straight, in radians (20°), are taken for those of a flattened curve. Doubled, those of an octagon are.
const NEARLY: f64 = 0.35;
/// Corners nearer to straight than this, in radians, are rounding of coordinates on one line.
const STRAIGHT: f64 = 1e-4;
/// Fewest such corners of one rim that are taken for a flattened curve: a polygon that is meant has fewer.
const MANY: usize = 8;

impl Outline {
    /// The number of corners between supported straight sides that are within 20° of straight, on rims that have at least eight of
    /// them; 0 for an invalid outline.
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
