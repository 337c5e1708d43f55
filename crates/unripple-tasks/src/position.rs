//! Places on the surface in requests.

use unripple::core::{Outline, Point};

/// A place on the surface, x and y in metres from the lower-left corner of the outline's bounding box.
pub type Place = [f64; 2];

/// Converts a place to a [`Point`], in m.
pub fn point(place: &Place) -> Point {
    Point::new(place[0], place[1])
}

/// Place at which a focus is tried if the request has no target, as shares of the outline's width and
/// height: on no line of symmetry, where half of the modes would stand still.
const ANYWHERE: [f64; 2] = [0.41, 0.6];

/// A place inside an outline, away from its lines of symmetry, at which a focus is tried if the request has
/// no target.
pub(crate) fn anywhere(outline: &Outline) -> Point {
    let (width, height) = outline.extent();
    outline.nearest(Point::new(ANYWHERE[0] * width, ANYWHERE[1] * height))
}
