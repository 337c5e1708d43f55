//! From a sensor's coordinates to the surface's.

use crate::error::TouchError;
use unripple_core::{Outline, Point, require};

/// The map from a sensor's coordinates to places on the surface.
///
/// Sensor coordinates go from 0 to 1 from the left and from 0 to 1 from the **top**; the surface has its origin at
/// the lower left, y up, in m.
///
/// ```
/// use unripple_core::{Outline, Point, Shape};
/// use unripple_touch::Mapping;
///
/// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
/// let mapping = Mapping::covering(&sheet);
/// assert_eq!(mapping.point(0.0, 1.0), Some(Point::new(0.0, 0.0)));
/// assert_eq!(mapping.point(1.0, 0.0), Some(Point::new(0.15, 0.10)));
/// assert_eq!(mapping.point(1.2, 0.0), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping {
    /// Lower-left corner of the sensor's area on the surface, in m, once it is mirrored and turned.
    pub offset: Point,
    /// Width and height of that area, in m.
    pub size: (f64, f64),
    /// Whether left and right change places, as they do for a camera that looks from below. Applied before turning and scaling.
    pub mirror: bool,
    /// Quarter turns anticlockwise, done after mirroring.
    pub turns: u8,
}

impl Mapping {
    /// A sensor that covers the bounding box of an outline, upright.
    pub fn covering(outline: &Outline) -> Self {
        Self { offset: Point::default(), size: outline.extent(), mirror: false, turns: 0 }
    }

    /// Place on the surface, in m, that corresponds to a sensor's coordinates; `None` if one of the
    /// coordinates is not from 0 to 1.
    pub fn point(&self, right: f64, down: f64) -> Option<Point> {
        let legal = 0.0..=1.0;
        if !legal.contains(&right) || !legal.contains(&down) {
            return None;
        }
        let (mut u, mut v) = (if self.mirror { 1.0 - right } else { right }, 1.0 - down);
        for _ in 0..self.turns % 4 {
            (u, v) = (1.0 - v, u);
        }
        Some(Point::new(self.offset.x + u * self.size.0, self.offset.y + v * self.size.1))
    }

    pub(crate) fn check(&self) -> Result<(), TouchError> {
        let (width, height) = self.size;
        require("width of the sensor, m", width > 0.0, "more than 0", width)?;
        require("height of the sensor, m", height > 0.0, "more than 0", height)?;
        require("left edge of the sensor, m", true, "a finite number", self.offset.x)?;
        Ok(require("lower edge of the sensor, m", true, "a finite number", self.offset.y)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of a sensor as it is seen: upper left, upper right, lower left.
    fn corners(mapping: &Mapping) -> [(f64, f64); 3] {
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| {
            let p = mapping.point(x, y).unwrap();
            (p.x, p.y)
        })
    }

    #[test]
    fn mirrors_then_turns_anticlockwise() {
        let plain = Mapping { offset: Point::new(1.0, 2.0), size: (4.0, 3.0), mirror: false, turns: 0 };
        assert_eq!(corners(&plain), [(1.0, 5.0), (5.0, 5.0), (1.0, 2.0)]);
        // Turned anticlockwise, the upper left is at the lower left, the upper right at the upper left.
        let turned = Mapping { turns: 1, ..plain };
        assert_eq!(corners(&turned), [(1.0, 2.0), (1.0, 5.0), (5.0, 2.0)]);
        let mirrored = Mapping { mirror: true, ..plain };
        assert_eq!(corners(&mirrored), [(5.0, 5.0), (1.0, 5.0), (5.0, 2.0)]);
        let both = Mapping { mirror: true, turns: 1, ..plain };
        assert_eq!(corners(&both), [(1.0, 5.0), (1.0, 2.0), (5.0, 5.0)]);
        assert_eq!(corners(&Mapping { turns: 4, ..plain }), corners(&plain));
    }

    #[test]
    fn refuses_what_is_no_place() {
        let mapping = Mapping { offset: Point::default(), size: (1.0, 1.0), mirror: false, turns: 0 };
        for (x, y) in
            [(f64::NAN, 0.5), (0.5, f64::NAN), (-1e-9, 0.5), (0.5, 1.0 + 1e-9), (f64::INFINITY, 0.5)]
        {
            assert_eq!(mapping.point(x, y), None);
        }
        assert!(Mapping { size: (0.0, 1.0), ..mapping }.check().is_err());
        assert!(Mapping { offset: Point::new(f64::NAN, 0.0), ..mapping }.check().is_err());
    }
}
