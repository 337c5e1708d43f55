//! Whether rims bound a sheet.

use super::piece::Piece;
use super::rims::{Rims, tangent};
use super::tree::Node;
use super::vector::{angle, between_segments, minus};
use crate::PhysicsError;
use std::f64::consts::PI;
use unripple_core::Point;

/// Rims nearer than this share of the extent touch.
const TOUCH: f64 = 1e-7;
/// Least angle between sides that meet, in radians.
const SHARPEST: f64 = 0.01;
/// Least area, as a share of the extent squared.
const AREA: f64 = 1e-9;
/// Halvings after which two pieces that cannot be told apart meet.
const DEEPEST: u32 = 60;

/// A typed error unless the rims cross nothing, enclose an area anticlockwise and their holes lie within.
pub(super) fn check(rims: &Rims) -> Result<(), PhysicsError> {
    let expected = "rims that neither cross nor touch themselves or each other";
    if let Some((p, [one, other])) = meeting(rims) {
        let rim = |side: usize| rims.loops.iter().position(|rim| rim.contains(&side)).unwrap_or(0);
        let found = match (rim(one), rim(other)) {
            (0, 0) => format!("an outer rim that meets itself at {p}"),
            (0, _) | (_, 0) => format!("a hole that meets the outer rim at {p}"),
            (a, b) if a == b => format!("a hole whose rim meets itself at {p}"),
            _ => format!("holes that meet at {p}"),
        };
        return Err(PhysicsError::Outline { expected, found });
    }
    let areas: Vec<f64> = (0..rims.loops.len()).map(|i| area(rims, i)).collect();
    let least = AREA * rims.extent * rims.extent;
    if areas[0].abs() < least {
        return Err(PhysicsError::Outline {
            expected: "an outer rim that encloses an area",
            found: format!("{:e} mm²", areas[0] * 1e6),
        });
    }
    if areas[0] < 0.0 {
        return Err(PhysicsError::Outline {
            expected: "sides listed anticlockwise",
            found: "an outer rim that runs clockwise".to_owned(),
        });
    }
    (1..rims.loops.len()).try_for_each(|hole| check_hole(rims, hole, areas[hole]))
}

fn check_hole(rims: &Rims, hole: usize, area: f64) -> Result<(), PhysicsError> {
    let p = rims.sides[rims.loops[hole].start].0.at(0.0);
    if area >= 0.0 {
        return Err(PhysicsError::Outline {
            expected: "holes whose sides are listed anticlockwise",
            found: format!("one through {p} that runs clockwise or has no area"),
        });
    }
    let around = |rim: usize| winding(rims, rim, p) != 0;
    let fault = if !around(0) {
        format!("one through {p}, outside the outer rim")
    } else if (1..rims.loops.len()).any(|other| other != hole && around(other)) {
        format!("one through {p}, within another")
    } else {
        return Ok(());
    };
    Err(PhysicsError::Outline { expected: "holes within the sheet", found: fault })
}

/// The pieces of one rim.
fn of_rim(rims: &Rims, rim: usize) -> impl Iterator<Item = &Piece> {
    let sides = rims.loops[rim].clone();
    rims.pieces.iter().filter(move |piece| sides.contains(&piece.side))
}

/// Signed area within a rim, in m², positive anticlockwise.
fn area(rims: &Rims, rim: usize) -> f64 {
    let origin = rims.sides[rims.loops[rim].start].0.at(0.0);
    let piece = |piece: &Piece| {
        let [a, b] = piece.ends.map(|p| minus(p, origin));
        piece.doubled_area(&rims.sides[piece.side].0) + a.x * b.y - a.y * b.x
    };
    0.5 * of_rim(rims, rim).map(piece).sum::<f64>()
}

/// How often a rim runs anticlockwise around a point that is not on it.
fn winding(rims: &Rims, rim: usize, p: Point) -> i64 {
    let angle: f64 = of_rim(rims, rim).map(|piece| piece.seen_from(p, &rims.sides[piece.side].0)).sum();
    (angle / (2.0 * PI)).round() as i64
}

/// Where two rims meet that should not, and their sides there.
fn meeting(rims: &Rims) -> Option<(Point, [usize; 2])> {
    let touch = TOUCH * rims.extent;
    for (i, piece) in rims.pieces.iter().enumerate() {
        let own = piece.bounds(touch);
        let mut found = None;
        let open = |found: &Option<_>, node: &Node| found.is_none() && node.bounds.meets(&own);
        rims.tree.search(&mut found, open, |found, j| {
            if j > i && found.is_none() {
                let other = &rims.pieces[j];
                *found = meet(rims, piece, other, touch, DEEPEST).map(|p| (p, [piece.side, other.side]));
            }
        });
        if found.is_some() {
            return found;
        }
    }
    let cusp = rims.pieces.iter().find(|piece| piece.turn > PI - SHARPEST)?;
    Some((cusp.ends[0], [cusp.side; 2]))
}

/// Where two pieces come nearer than `touch`, ends that belong together left out.
fn meet(rims: &Rims, one: &Piece, other: &Piece, touch: f64, depth: u32) -> Option<Point> {
    let curved = one.sagitta + other.sagitta;
    if between_segments(one.ends, other.ends) > curved + touch {
        return None;
    }
    if follows(rims, one, other) {
        return meet_at_joint(rims, one, other, touch, depth);
    }
    if follows(rims, other, one) {
        return meet_at_joint(rims, other, one, touch, depth);
    }
    if curved < 0.1 * touch || depth == 0 {
        return Some(one.ends[0]);
    }
    if one.sagitta >= other.sagitta {
        let halves = one.halves(&rims.sides[one.side].0);
        halves.iter().find_map(|half| meet(rims, half, other, touch, depth - 1))
    } else {
        let halves = other.halves(&rims.sides[other.side].0);
        halves.iter().find_map(|half| meet(rims, one, half, touch, depth - 1))
    }
}

/// Whether `other` starts where `one` ends.
fn follows(rims: &Rims, one: &Piece, other: &Piece) -> bool {
    let inner = one.side == other.side && one.span[1] == other.span[0];
    inner || (one.span[1] == 1.0 && other.span[0] == 0.0 && rims.next(one.side) == other.side)
}

/// The same of two pieces that follow each other: unless they turn by more than the angle between them, they have only
/// that point in common.
fn meet_at_joint(rims: &Rims, one: &Piece, other: &Piece, touch: f64, depth: u32) -> Option<Point> {
    let back = tangent(&rims.sides[one.side].0, one.span[1]);
    let on = tangent(&rims.sides[other.side].0, other.span[0]);
    let opening = PI - angle(back, on).abs();
    if opening < SHARPEST || depth == 0 {
        return Some(other.ends[0]);
    }
    if one.turn + other.turn < opening && !follows(rims, other, one) {
        return None;
    }
    let (near, far) = if one.turn >= other.turn {
        let [far, near] = one.halves(&rims.sides[one.side].0);
        ([near, *other], [far, *other])
    } else {
        let [near, far] = other.halves(&rims.sides[other.side].0);
        ([*one, near], [*one, far])
    };
    meet(rims, &far[0], &far[1], touch, depth - 1)
        .or_else(|| meet_at_joint(rims, &near[0], &near[1], touch, depth - 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Hole, Outline, Shape, Side};

    fn fault(outline: &Outline) -> String {
        Rims::new(outline).unwrap_err().to_string()
    }

    fn polygon(points: &[(f64, f64)]) -> Outline {
        Outline::new(Shape::Polygon(points.iter().map(|&(x, y)| Point::from_mm(x, y)).collect()))
    }

    fn sheet() -> Outline {
        Outline::new(Shape::Rectangle { width: 0.1, height: 0.1 })
    }

    fn disc(radius: f64, x: f64, y: f64) -> Hole {
        Hole::new(&Shape::Circle { radius }, Point::from_mm(x, y))
    }

    #[test]
    fn rims_that_meet_are_refused() {
        let bow = polygon(&[(0.0, 0.0), (100.0, 100.0), (100.0, 0.0), (0.0, 150.0)]);
        assert!(fault(&bow).contains("meets itself at ("), "{}", fault(&bow));
        let pinched = polygon(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (50.0, 0.0), (0.0, 100.0)]);
        assert!(fault(&pinched).contains("meets itself at ("));
        let spike = polygon(&[(0.0, 0.0), (100.0, 0.0), (150.0, 0.0), (100.0, 0.0), (50.0, 80.0)]);
        assert!(fault(&spike).contains("meets itself"));
        assert!(
            fault(&sheet().with_hole(disc(0.02, 70.0, 20.0))).contains("a hole that meets the outer rim at")
        );
        assert!(
            fault(&sheet().with_hole(disc(0.02, 60.0, 20.0))).contains("a hole that meets the outer rim at")
        );
        let touching = sheet().with_hole(disc(0.02, 5.0, 20.0)).with_hole(disc(0.02, 45.0, 20.0));
        assert!(fault(&touching).contains("holes that meet at (45.0000, 40.0"), "{}", fault(&touching));
        let apart = sheet().with_hole(disc(0.02, 5.0, 20.0)).with_hole(disc(0.02, 45.001, 20.0));
        assert!(Rims::new(&apart).is_ok());
        let loop_of = Side::Cubic(
            [(0.0, 0.0), (300.0, 200.0), (-200.0, 200.0), (100.0, 0.0)].map(|(x, y)| Point::from_mm(x, y)),
        );
        let close = Side::Line { from: loop_of.at(1.0), to: loop_of.at(0.0) };
        assert!(fault(&Outline::new(Shape::Path(vec![loop_of, close]))).contains("meets itself"));
    }

    #[test]
    fn misplaced_holes_are_refused() {
        assert!(fault(&sheet().with_hole(disc(0.02, 170.0, 20.0))).contains("outside the outer rim"));
        let nested = sheet().with_hole(disc(0.04, 10.0, 10.0)).with_hole(disc(0.01, 40.0, 40.0));
        assert!(fault(&nested).contains("within another"));
        let around = sheet().with_hole(disc(0.2, -150.0, -150.0));
        assert!(fault(&around).contains("outside the outer rim"));
        let mut turned = disc(0.02, 20.0, 20.0);
        turned.sides = turned.sides.into_iter().map(Side::reversed).collect();
        assert!(fault(&sheet().with_hole(turned)).contains("clockwise"));
    }

    #[test]
    fn outlines_without_a_sheet_are_refused() {
        assert!(fault(&polygon(&[(0.0, 0.0), (0.0, 100.0), (100.0, 100.0)])).contains("clockwise"));
        let flat = polygon(&[(0.0, 0.0), (50.0, 0.0), (100.0, 0.0)]);
        assert!(fault(&flat).contains("meets itself") || fault(&flat).contains("area"));
        assert!(fault(&polygon(&[(0.0, 0.0), (f64::NAN, 0.0), (100.0, 0.0)])).contains("finite"));
        assert!(
            fault(&polygon(&[(0.0, 0.0), (100.0, 0.0), (100.0, 0.0), (0.0, 90.0)]))
                .contains("without length")
        );
        assert!(fault(&polygon(&[])).contains("without sides"));
        let open = Side::Line { from: Point::new(0.0, 0.0), to: Point::new(0.1, 0.0) };
        let away = Side::Line { from: Point::new(0.1, 0.1), to: Point::new(0.0, 0.0) };
        assert!(fault(&Outline::new(Shape::Path(vec![open, away]))).contains("a side that ends at"));
        assert!(fault(&Outline::new(Shape::Circle { radius: 0.0 })).contains("positive radii"));
    }

    #[test]
    fn sharp_corners_and_close_curves_are_sheets() {
        let needle = polygon(&[(0.0, 0.0), (100.0, 0.0), (100.0, 3.0)]);
        assert!(Rims::new(&needle).is_ok());
        let slit = Hole::slit(Point::from_mm(20.0, 20.0), Point::from_mm(80.0, 50.0), 1e-5);
        assert!(Rims::new(&sheet().with_hole(slit)).is_ok());
    }
}
