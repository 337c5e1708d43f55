//! Areas of the plane: what is inside a polygon, and what of an actuator reaches into one.

use unripple_core::plane::{from_segment, minus};
use unripple_core::{Patch, Point};

/// Share of a rectangular patch by which it may reach into an area: rounding of millimetres in a request is no fault.
const ROUNDING: f64 = 1e-9;

/// Whether a polygon, given by its corners (m), encloses a point (m): by the number of its sides that a ray to the right crosses.
///
/// ```
/// use unripple_core::Point;
///
/// let corner = [(0.0, 0.0), (30.0, 0.0), (0.0, 30.0)].map(|(x, y)| Point::from_mm(x, y));
/// assert!(unripple_placement::encloses(&corner, Point::from_mm(10.0, 10.0)));
/// assert!(!unripple_placement::encloses(&corner, Point::from_mm(20.0, 20.0)));
/// ```
pub fn encloses(polygon: &[Point], p: Point) -> bool {
    let crossed = sides(polygon)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x));
    crossed.count() % 2 == 1
}

/// Whether a patch about a point (m) reaches into a polygon; it may touch it.
pub(crate) fn reaches_into(patch: Patch, at: Point, polygon: &[Point]) -> bool {
    // A patch is in one piece: with its centre outside and no side within it, the whole of it is outside.
    encloses(polygon, at)
        || match patch {
            Patch::Round { radius } => {
                sides(polygon).any(|(a, b)| from_segment(at, a, b) < radius * (1.0 - ROUNDING))
            }
            Patch::Rectangular { sides: lengths, angle } => {
                sides(polygon).any(|(a, b)| crosses(lengths, angle, minus(a, at), minus(b, at)))
            }
        }
}

/// The sides of a polygon, each by its ends.
fn sides(polygon: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// Whether a side, by its ends relative to the centre of a turned rectangle, has a part inside it: the side is clipped at both pairs of
/// parallel edges (Y.-D. Liang, B. A. Barsky, *ACM Trans. Graphics* 3, 1, 1984).
fn crosses([width, height]: [f64; 2], angle: f64, a: Point, b: Point) -> bool {
    let (sin, cos) = angle.sin_cos();
    let place = |p: Point| [p.x * cos + p.y * sin, p.y * cos - p.x * sin];
    let (from, to) = (place(a), place(b));
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for ((start, end), length) in from.into_iter().zip(to).zip([width, height]) {
        let (half, step) = (0.5 * (1.0 - ROUNDING) * length, end - start);
        if step == 0.0 && start.abs() >= half {
            return false;
        }
        if step != 0.0 {
            let (one, other) = ((-half - start) / step, (half - start) / step);
            first = first.max(one.min(other));
            last = last.min(one.max(other));
        }
    }
    first < last
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(all: &[(f64, f64)]) -> Vec<Point> {
        all.iter().map(|(x, y)| Point::from_mm(*x, *y)).collect()
    }

    #[test]
    fn areas_that_are_not_convex_enclose_what_they_do() {
        let bracket =
            corners(&[(0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (10.0, 10.0), (10.0, 30.0), (0.0, 30.0)]);
        assert!(
            encloses(&bracket, Point::from_mm(20.0, 5.0)) && encloses(&bracket, Point::from_mm(5.0, 20.0))
        );
        assert!(
            !encloses(&bracket, Point::from_mm(20.0, 20.0)) && !encloses(&bracket, Point::from_mm(-1.0, 5.0))
        );
    }

    #[test]
    fn discs_reach_as_far_as_their_radius() {
        let square = corners(&[(20.0, 20.0), (40.0, 20.0), (40.0, 40.0), (20.0, 40.0)]);
        let disc = Patch::Round { radius: 5e-3 };
        // Beside a side, and beyond a corner at 3, 4 and 5 mm.
        for (x, y, reaches) in [
            (15.0, 30.0, false),
            (15.1, 30.0, true),
            (44.9, 30.0, true),
            (17.0, 16.0, false),
            (17.1, 16.1, true),
            (30.0, 30.0, true),
        ] {
            assert_eq!(reaches_into(disc, Point::from_mm(x, y), &square), reaches, "{x}, {y}");
        }
        assert!(!reaches_into(Patch::Round { radius: 0.0 }, Point::from_mm(19.9, 30.0), &square));
    }

    #[test]
    fn rectangles_reach_as_far_as_they_are_turned() {
        let square = corners(&[(20.0, 20.0), (40.0, 20.0), (40.0, 40.0), (20.0, 40.0)]);
        let long = |angle: f64| Patch::Rectangular { sides: [20e-3, 4e-3], angle };
        let beside = Point::from_mm(12.0, 30.0);
        assert!(reaches_into(long(0.0), beside, &square));
        assert!(!reaches_into(long(std::f64::consts::FRAC_PI_2), beside, &square));
        // An area that is smaller than the patch, in the middle of its half.
        let small = corners(&[(5.0, -0.5), (6.0, -0.5), (6.0, 0.5), (5.0, 0.5)]);
        assert!(reaches_into(long(0.0), Point::new(0.0, 0.0), &small));
        // Edge to edge is no overlap.
        assert!(!reaches_into(long(0.0), Point::from_mm(10.0, 30.0), &square));
    }
}
