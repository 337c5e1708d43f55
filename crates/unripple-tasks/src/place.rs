//! Places in asks.

use unripple::core::Point;

/// A place on the surface, x and y in metres from the lower-left corner of the outline's bounding box.
pub type Place = [f64; 2];

/// The same as the rest of the library has it.
pub fn point(place: &Place) -> Point {
    Point::new(place[0], place[1])
}
