//! Places in asks.

use unripple::core::Point;

/// A place on the surface, x and y in metres from the lower-left corner of the outline's bounding box.
pub type Place = [f64; 2];

/// The place as a point of the library, in m.
pub fn point(place: &Place) -> Point {
    Point::new(place[0], place[1])
}
