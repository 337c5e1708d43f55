//! Rules for where actuators may be.

use crate::PlacementError;
use unripple_core::{Outline, Point, require};

/// Largest number of cells of a grid of places. With twice this value, a search would take a GiB for every ten targets.
const MOST_CELLS: f64 = 4e6;

/// Where actuators may be: within a range of distances from the rim, inside some areas, outside others.
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
    /// Areas in which no place may be, as polygons (m).
    pub keep_out: Vec<Vec<Point>>,
}

impl Default for Rules {
    /// Anywhere on the sheet.
    fn default() -> Self {
        Self { from_rim: [0.0, f64::INFINITY], within: Vec::new(), keep_out: Vec::new() }
    }
}

impl Rules {
    /// Whether an actuator may be at a point (m) of a sheet.
    pub fn allow(&self, outline: &Outline, at: Point) -> bool {
        let inside = |areas: &[Vec<Point>]| areas.iter().any(|area| encloses(area, at));
        let [least, most] = self.from_rim;
        (self.within.is_empty() || inside(&self.within))
            && !inside(&self.keep_out)
            && outline.contains(at)
            && (least..=most).contains(&outline.to_rim(at))
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

/// Whether a polygon encloses a point, by the number of its sides that a ray to the right crosses.
fn encloses(polygon: &[Point], p: Point) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crossed = polygon
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x));
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Hole, Shape};

    #[test]
    fn areas_that_are_not_convex_enclose_what_they_do() {
        let corner = |(x, y)| Point::from_mm(x, y);
        let bracket =
            [(0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (10.0, 10.0), (10.0, 30.0), (0.0, 30.0)].map(corner);
        assert!(
            encloses(&bracket, Point::from_mm(20.0, 5.0)) && encloses(&bracket, Point::from_mm(5.0, 20.0))
        );
        assert!(
            !encloses(&bracket, Point::from_mm(20.0, 20.0)) && !encloses(&bracket, Point::from_mm(-1.0, 5.0))
        );
    }

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
    fn refuses_grids_without_end() {
        let sheet = Outline::new(Shape::Rectangle { width: 0.2, height: 0.1 });
        for pitch in [0.0, -1.0, f64::NAN, 1e-6] {
            assert!(matches!(Rules::default().grid(&sheet, pitch), Err(PlacementError::Range(_))), "{pitch}");
        }
    }
}
