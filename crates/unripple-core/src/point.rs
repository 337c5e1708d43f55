//! A place on the surface, in metres.

/// A place on the surface, in metres from the lower-left corner of the outline's bounding box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// The x coordinate, to the right, in metres.
    pub x: f64,
    /// The y coordinate, upwards, in metres.
    pub y: f64,
}

impl Point {
    /// A point from coordinates in metres.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// A point from coordinates in millimetres, as files and the command line write them.
    pub fn from_mm(x: f64, y: f64) -> Self {
        Self { x: x / 1e3, y: y / 1e3 }
    }

    /// Distance to another point, in metres.
    pub fn distance(self, other: Self) -> f64 {
        (self.x - other.x).hypot(self.y - other.y)
    }

    /// Whether both coordinates are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl std::fmt::Display for Point {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "({:.4}, {:.4}) mm", self.x * 1e3, self.y * 1e3)
    }
}
