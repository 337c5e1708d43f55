//! Rules for where actuators may be.

use crate::PlacementError;
use crate::area::{encloses, reaches_into};
use unripple_core::{Outline, Patch, Point, require};

/// Largest number of cells of a grid of places. With twice this value, a search would take a GiB for every ten targets.
const MOST_CELLS: f64 = 4e6;

/// Where actuators may be: within a range of distances from the rim, inside some areas, outside others. Distances from the rim, and the
/// areas inside, are those of their centres; outside other areas, and on the sheet, is the whole of their footprint.
///
/// ```
/// use unripple_core::{Outline, Point, Shape};
/// use unripple_placement::Rules;
///
/// let film = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
/// let rules = Rules { from_rim: [6e-3, 12e-3], ..Rules::default() };
/// let places = rules.grid(&film, 2e-3)?;
/// assert!(places.len() > 700 && places.iter().all(|place| rules.allow(&film, *place)));
/// assert!(!rules.allow(&film, Point::from_mm(75.0, 75.0)));
/// # Ok::<(), unripple_placement::PlacementError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Rules {
    /// Least and greatest distance from the nearest rim, of holes too, in metres.
    pub from_rim: [f64; 2],
    /// Areas in one of which a place must be, as polygons (m); empty for the whole surface.
    pub within: Vec<Vec<Point>>,
    /// Areas into which no footprint may reach, as polygons (m).
    pub keep_out: Vec<Vec<Point>>,
    /// What an actuator covers of the sheet, about its place; a disc of radius 0 for a point.
    pub footprint: Patch,
}

impl Default for Rules {
    /// Anywhere on the sheet, for points.
    fn default() -> Self {
        let footprint = Patch::Round { radius: 0.0 };
        Self { from_rim: [0.0, f64::INFINITY], within: Vec::new(), keep_out: Vec::new(), footprint }
    }
}

impl Rules {
    /// Whether an actuator may be at a point (m) of a sheet.
    pub fn allow(&self, outline: &Outline, at: Point) -> bool {
        let [least, most] = self.from_rim;
        (self.within.is_empty() || self.within.iter().any(|area| encloses(area, at)))
            && self.keeps_out(self.footprint, at)
            && outline.contains(at)
            && (least..=most).contains(&outline.to_rim(at))
            && self.lies_on(outline, at)
    }

    /// Whether an actuator of a footprint at a point (m) reaches into none of the areas in which there may be none.
    pub fn keeps_out(&self, footprint: Patch, at: Point) -> bool {
        !self.keep_out.iter().any(|area| reaches_into(footprint, at, area))
    }

    /// Whether the footprint of an actuator at a point (m) is wholly on a sheet.
    fn lies_on(&self, outline: &Outline, at: Point) -> bool {
        // A point on the sheet is, and no distances need be computed.
        self.footprint == Patch::Round { radius: 0.0 } || self.footprint.lies_on(outline, at)
    }

    /// The allowed points of a grid of square cells of side `pitch` (m) over a sheet, row by row from the bottom. The grid is centred on
    /// the bounding box of the outline.
    ///
    /// # Errors
    /// [`PlacementError::Range`] for a pitch that is not positive, or with which the grid has more than 4·10⁶ cells.
    pub fn grid(&self, outline: &Outline, pitch: f64) -> Result<Vec<Point>, PlacementError> {
        let (width, height) = outline.extent();
        require("pitch of the places (m)", pitch > 0.0, "a positive number", pitch)?;
        let [columns, rows] = [width, height].map(|side| (side / pitch).floor() + 1.0);
        let expected = format!("at most {MOST_CELLS}");
        require("cells of the grid of places", columns * rows <= MOST_CELLS, expected, columns * rows)?;
        let at = |side: f64, count: f64, i: usize| 0.5 * (side - (count - 1.0) * pitch) + i as f64 * pitch;
        let points = (0..rows as usize).flat_map(|row| {
            (0..columns as usize).map(move |c| Point::new(at(width, columns, c), at(height, rows, row)))
        });
        Ok(points.filter(|point| self.allow(outline, *point)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Hole, Shape};

    #[test]
    fn rims_of_holes_count_and_areas_are_kept_out() {
        let hole = Hole::new(&Shape::Circle { radius: 0.02 }, Point::from_mm(30.0, 30.0));
        let sheet = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 }).with_hole(hole);
        let rules = Rules {
            from_rim: [5e-3, 8e-3],
            keep_out: vec![
                [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)]
                    .map(|(x, y)| Point::from_mm(x, y))
                    .to_vec(),
            ],
            ..Rules::default()
        };
        assert!(!rules.allow(&sheet, Point::from_mm(76.0, 50.0)), "beside the hole, but kept out");
        assert!(Rules { keep_out: Vec::new(), ..rules.clone() }.allow(&sheet, Point::from_mm(76.0, 50.0)));
        assert!(
            rules.allow(&sheet, Point::from_mm(150.0, 6.0))
                && !rules.allow(&sheet, Point::from_mm(150.0, 50.0))
        );
    }

    #[test]
    fn footprints_stay_on_the_sheet_and_out_of_areas() {
        let sheet = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
        let corners = [(90.0, 0.0), (110.0, 0.0), (110.0, 100.0), (90.0, 100.0)];
        let keep_out = vec![corners.map(|(x, y)| Point::from_mm(x, y)).to_vec()];
        let points = Rules { keep_out, ..Rules::default() };
        let discs = Rules { footprint: Patch::Round { radius: 6e-3 }, ..points.clone() };
        // 5 mm from the rim, from the area, and from neither.
        for (x, y, fits) in [(5.0, 50.0, false), (85.0, 50.0, false), (50.0, 50.0, true)] {
            let at = Point::from_mm(x, y);
            assert!(points.allow(&sheet, at), "{at}");
            assert_eq!(discs.allow(&sheet, at), fits, "{at}");
        }
        let pitch = 5e-3;
        let (all, fewer) = (points.grid(&sheet, pitch).unwrap(), discs.grid(&sheet, pitch).unwrap());
        assert!(fewer.len() < all.len() && fewer.iter().all(|at| all.contains(at)));
    }

    #[test]
    fn refuses_grids_without_end() {
        let sheet = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
        for pitch in [0.0, -1.0, f64::NAN, 1e-6] {
            assert!(matches!(Rules::default().grid(&sheet, pitch), Err(PlacementError::Range(_))), "{pitch}");
        }
    }
}
