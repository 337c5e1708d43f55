//! Outlines of piezo patches.

use crate::{Outline, Point, Side};
use std::f64::consts::PI;

/// The outline of a piezo patch about its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Patch {
    /// A disc.
    Round {
        /// Its radius, in metres.
        radius: f64,
    },
    /// A rectangle.
    Rectangular {
        /// Its width and height, in metres.
        sides: [f64; 2],
        /// Angle by which the patch is turned, in radians anticlockwise.
        angle: f64,
    },
}

/// Number of intervals in which a side of a boundary is searched for its deepest place in a rectangle. Doubled, notches half as wide
/// are found.
const LATTICE: usize = 64;

/// Steps of golden-section search within such an interval: it ends at 1e-9 of the side.
const STEPS: usize = 44;

impl Patch {
    /// Area of the patch, in m².
    pub fn area(&self) -> f64 {
        match *self {
            Self::Round { radius } => PI * radius * radius,
            Self::Rectangular { sides: [width, height], .. } => width * height,
        }
    }

    /// Whether the patch, about a point of the sheet (m), lies wholly on the sheet; it may touch the boundary.
    ///
    /// ```
    /// use unripple_core::{Outline, Patch, Point, Shape};
    ///
    /// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
    /// let patch = Patch::Rectangular { sides: [0.04, 0.02], angle: 0.0 };
    /// assert!(patch.lies_on(&sheet, Point::from_mm(20.0, 10.0)));
    /// assert!(!patch.lies_on(&sheet, Point::from_mm(19.0, 10.0)));
    /// ```
    pub fn lies_on(&self, outline: &Outline, centre: Point) -> bool {
        match *self {
            Self::Round { radius } => outline.holds_disc(centre, radius),
            // It is in one piece: with its centre on the sheet and no boundary within it, the whole of it is on the sheet.
            Self::Rectangular { sides, angle } => {
                let rims = outline.loops().into_iter().flat_map(|rim| rim.sides);
                // Rounding of millimetres in a file is no fault.
                outline.contains(centre)
                    && rims
                        .map(|(side, _)| depth(&side, centre, sides, angle))
                        .all(|share| share >= 1.0 - 1e-9)
            }
        }
    }
}

/// Size of the largest rectangle of the same proportions that a side of a boundary does not enter, as a share of the rectangle.
fn depth(side: &Side, centre: Point, [width, height]: [f64; 2], angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let share = |t: f64| {
        let p = side.at(t);
        let (x, y) = (p.x - centre.x, p.y - centre.y);
        let (along, across) = (x * cos + y * sin, y * cos - x * sin);
        (2.0 * along / width).abs().max((2.0 * across / height).abs())
    };
    let at = |i: usize| i as f64 / LATTICE as f64;
    let least = (0..=LATTICE).min_by(|a, b| share(at(*a)).total_cmp(&share(at(*b)))).unwrap_or(0);
    let (mut low, mut high) = (at(least.saturating_sub(1)), at((least + 1).min(LATTICE)));
    // Along a line the share is convex, so that its least value is between the neighbours of the lattice's least.
    const GOLDEN: f64 = 0.618_033_988_749_895;
    for _ in 0..STEPS {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if share(left) < share(right) { high = right } else { low = left }
    }
    share(0.5 * (low + high)).min(share(at(least)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Hole, Shape};

    #[test]
    fn a_turned_patch_in_a_circle_touches_with_its_corners() {
        // A circle of radius 50 mm about (50, 50): a rectangle of diagonal 2 r fits in its middle, whatever its angle.
        let sheet = Outline::new(Shape::Circle { radius: 0.05 });
        let middle = Point::new(0.05, 0.05);
        for angle in [0.0, 0.3, 1.0, 2.5] {
            for (scale, fits) in [(0.999, true), (1.001, false)] {
                let sides = [0.06 * scale, 0.08 * scale];
                assert_eq!(
                    Patch::Rectangular { sides, angle }.lies_on(&sheet, middle),
                    fits,
                    "{angle} {scale}"
                );
            }
        }
        assert!(
            !Patch::Rectangular { sides: [0.01, 0.01], angle: 0.0 }.lies_on(&sheet, Point::new(0.2, 0.2))
        );
    }

    #[test]
    fn a_patch_over_a_hole_lies_not_on_the_sheet() {
        let mut sheet = Outline::new(Shape::Rectangle { width: 0.2, height: 0.2 });
        sheet.holes = vec![Hole::new(&Shape::Circle { radius: 0.005 }, Point::new(0.095, 0.115))];
        let at = |y: f64| Point::new(0.1, y);
        let patch = Patch::Rectangular { sides: [0.08, 0.03], angle: 0.0 };
        // The hole reaches from 115 to 125 mm.
        assert!(patch.lies_on(&sheet, at(0.1)) && patch.lies_on(&sheet, at(0.14)));
        assert!(!patch.lies_on(&sheet, at(0.1001)) && !patch.lies_on(&sheet, at(0.125)));
        let turned = Patch::Rectangular { sides: [0.03, 0.08], angle: PI / 2.0 };
        assert!(turned.lies_on(&sheet, at(0.1)) && !turned.lies_on(&sheet, at(0.1001)));
    }
}
