//! Outlines of piezo patches.

use crate::{Outline, Point, Side};
use std::f64::consts::PI;

/// The shape of a piezo patch and its size, relative to the patch's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Patch {
    /// A disc around the centre of the patch.
    Round {
        /// Radius of the disc, in metres.
        radius: f64,
    },
    /// A rectangle around the centre of the patch.
    Rectangular {
        /// Width and height of the rectangle before it is turned, in metres.
        sides: [f64; 2],
        /// Angle by which the rectangle is turned, in radians anticlockwise.
        angle: f64,
    },
}

/// Number of intervals of a curved side of the boundary in each of which the search looks for the point
/// deepest inside a rectangular patch. With twice this value, notches half as wide are found.
const LATTICE: usize = 64;

/// Steps of golden-section search around each deepest point: the search ends within 1e-9 of the length of
/// the side.
const STEPS: usize = 44;

/// Share of an interval at which golden-section search looks.
const GOLDEN: f64 = 0.618_033_988_749_895;

impl Patch {
    /// Area of the patch, in m².
    pub fn area(&self) -> f64 {
        match *self {
            Self::Round { radius } => PI * radius * radius,
            Self::Rectangular { sides: [width, height], .. } => width * height,
        }
    }

    /// Whether the patch lies wholly on the sheet when it is centred at the point `centre` (m); it may
    /// touch the boundary.
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

/// Size of the largest rectangle about the same centre and of the same proportions that a side of the
/// boundary does not enter, relative to the size of the given rectangle.
fn depth(side: &Side, centre: Point, [width, height]: [f64; 2], angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    // A point of the side in the rectangle's axes, with half its sides as units.
    let place = |t: f64| {
        let p = side.at(t);
        let (x, y) = (p.x - centre.x, p.y - centre.y);
        [2.0 * (x * cos + y * sin) / width, 2.0 * (y * cos - x * sin) / height]
    };
    let share = |t: f64| place(t).map(f64::abs).into_iter().fold(0.0, f64::max);
    let least = |places: &mut dyn Iterator<Item = f64>| places.map(share).fold(f64::INFINITY, f64::min);
    if side.is_straight() {
        // The larger of two distances from a line is least at an end, or where one of them is 0, or where both are equal.
        let ([x0, y0], [x1, y1]) = (place(0.0), place(1.0));
        let zero = |from: f64, to: f64| from / (from - to);
        let turns = [zero(x0, x1), zero(y0, y1), zero(x0 - y0, x1 - y1), zero(x0 + y0, x1 + y1)];
        let within = turns.into_iter().filter(|t| (0.0..=1.0).contains(t));
        return least(&mut within.chain([0.0, 1.0]));
    }
    // Around each least place of the lattice: a curve may enter a thin rectangle anywhere.
    let at = |i: usize| i as f64 / LATTICE as f64;
    let shares: Vec<f64> = (0..=LATTICE).map(|i| share(at(i))).collect();
    let lowest = (0..=LATTICE).filter(|i| {
        let around = i.saturating_sub(1)..=(i + 1).min(LATTICE);
        around.into_iter().all(|j| shares[*i] <= shares[j])
    });
    least(&mut lowest.map(|i| deepest(&share, at(i.saturating_sub(1)), at((i + 1).min(LATTICE)))))
}

/// Least value of a function between two parameters, by golden-section search.
fn deepest(share: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..STEPS {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if share(left) < share(right) { high = right } else { low = left }
    }
    0.5 * (low + high)
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
