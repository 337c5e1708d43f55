//! The check that the rims (boundary curves) of an outline enclose a sheet: closed, without crossings,
//! anticlockwise, holes inside and apart.

use super::faults::OutlineFault;
use super::meeting::{Endless, meetings};
use super::rims::Rims;
use crate::{Edge, Outline, Side};
use std::ops::Range;

/// Largest gap between the end of a side and the start of the next, as a share of the extent: above the
/// rounding of coordinates that were computed. With twice this value, gaps twice as wide would count as closed.
const OPEN: f64 = 1e-9;
/// Least area of a sheet, relative to the extent squared: a smaller area is only rounding error of
/// coordinates on one line.
const AREA: f64 = 1e-9;

impl Outline {
    /// All reasons for which the outline encloses no valid sheet; empty for a valid outline. Both the
    /// reader of surface files and the mesh generator rely on this check.
    ///
    /// ```
    /// use unripple_core::{Outline, Point, Shape};
    ///
    /// let bow = [(0.0, 0.0), (100.0, 100.0), (100.0, 0.0), (0.0, 150.0)];
    /// let bow = Outline::new(Shape::Polygon(bow.map(|(x, y)| Point::from_mm(x, y)).to_vec()));
    /// assert!(bow.faults()[0].to_string().contains("an outer rim that meets itself at (60.0000, 60.0000) mm"));
    /// ```
    pub fn faults(&self) -> Vec<OutlineFault> {
        Rims::new(self).err().unwrap_or_default()
    }
}

impl Rims {
    /// The rims (boundary curves) of an outline, after a check that they enclose a sheet.
    ///
    /// # Errors
    /// All faults found. If sides are invalid or rims are not closed, only these faults are listed.
    pub fn new(outline: &Outline) -> Result<Self, Vec<OutlineFault>> {
        let (mut all, mut loops) = (Vec::new(), Vec::new());
        for rim in outline.loops() {
            loops.push(all.len()..all.len() + rim.sides.len());
            all.extend(rim.sides);
        }
        sides(&all, &loops)?;
        let found = Self::of(all, loops);
        rims(&found)?;
        Ok(found)
    }
}

/// Checks that each rim has sides, and that all sides have finite coordinates and a length. `loops` holds
/// the index range of each rim's sides.
fn sides(sides: &[(Side, Edge)], loops: &[Range<usize>]) -> Result<(), Vec<OutlineFault>> {
    let mut faults = Vec::new();
    for (rim, range) in loops.iter().enumerate() {
        if range.is_empty() {
            faults.push(OutlineFault::Empty { rim });
        }
        for (side, (curve, _)) in sides[range.clone()].iter().enumerate() {
            if !is_whole(curve) {
                faults.push(OutlineFault::Unbounded { rim, side });
            } else if curve.length() <= 0.0 {
                faults.push(OutlineFault::Pointlike { rim, side, at: curve.at(0.0) });
            }
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// Whether a side has finite coordinates, and an arc a positive radius.
fn is_whole(side: &Side) -> bool {
    match side {
        Side::Line { from, to } => from.is_finite() && to.is_finite(),
        Side::Arc { centre, radius, start, sweep } => {
            centre.is_finite()
                && radius.is_finite()
                && *radius > 0.0
                && start.is_finite()
                && sweep.is_finite()
        }
        Side::Cubic(p) => p.iter().all(|p| p.is_finite()),
    }
}

/// Checks that rims are closed, do not meet, enclose an area anticlockwise, and that holes lie inside.
fn rims(rims: &Rims) -> Result<(), Vec<OutlineFault>> {
    open(rims)?;
    let met = meetings(rims).map_err(|Endless| vec![OutlineFault::TooMany])?;
    let local = |side: usize| side - rims.loops[rims.rim_of(side)].start;
    let mut faults: Vec<OutlineFault> = met
        .iter()
        .map(|(pair, (sides, at))| OutlineFault::Meeting { rims: *pair, sides: sides.map(local), at: *at })
        .collect();
    // The area that a rim encloses is not defined if it meets itself or an earlier rim.
    let apart: Vec<bool> =
        (0..rims.loops.len()).map(|rim| met.keys().all(|[_, later]| *later != rim)).collect();
    for rim in (0..rims.loops.len()).filter(|rim| apart[*rim]) {
        faults.extend(course(rims, rim, &apart));
    }
    faults.sort_by_key(OutlineFault::rim);
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}
/// A fault for each side that starts farther from the end of the one before it than [`OPEN`] allows.
fn open(rims: &Rims) -> Result<(), Vec<OutlineFault>> {
    let fault = |side: usize| {
        let (end, start) = (rims.sides[rims.previous(side)].0.at(1.0), rims.sides[side].0.at(0.0));
        let rim = rims.rim_of(side);
        (end.distance(start) > OPEN * rims.extent).then(|| OutlineFault::Open {
            rim,
            side: side - rims.loops[rim].start,
            end,
            start,
        })
    };
    let faults: Vec<OutlineFault> = (0..rims.sides.len()).filter_map(fault).collect();
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

/// Checks the area and direction of a rim, and the position of a hole; returns the first fault found.
fn course(rims: &Rims, rim: usize, apart: &[bool]) -> Option<OutlineFault> {
    let at = rims.sides[rims.loops[rim].start].0.at(0.0);
    // The rims of holes run clockwise.
    let area = if rim == 0 { rims.area(rim) } else { -rims.area(rim) };
    let least = if rim == 0 { AREA * rims.extent * rims.extent } else { 0.0 };
    if area.abs() <= least {
        return Some(OutlineFault::Flat { rim, area, at });
    }
    if area < 0.0 {
        return Some(OutlineFault::Clockwise { rim, at });
    }
    if rim == 0 {
        return None;
    }
    let around = |other: &usize| rims.winding(*other, at) != 0;
    if apart[0] && !around(&0) {
        return Some(OutlineFault::Outside { rim, at });
    }
    let within = (1..rims.loops.len()).filter(|other| *other != rim && apart[*other]).find(around)?;
    Some(OutlineFault::Nested { rim, within, at })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Hole, Point, Shape};

    fn fault(outline: &Outline) -> String {
        outline.faults()[0].to_string()
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
        let apart = sheet().with_hole(disc(0.02, 5.0, 20.0)).with_hole(disc(0.02, 45.002, 20.0));
        assert!(apart.faults().is_empty());
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
        assert!(needle.faults().is_empty());
        let slit = Hole::slit(Point::from_mm(20.0, 20.0), Point::from_mm(80.0, 50.0), 1e-5);
        assert!(sheet().with_hole(slit).faults().is_empty());
    }
}
