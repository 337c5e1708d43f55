//! The points of a library: a square grid over a surface, and single places.

use crate::numbers::above_zero;
use crate::{Place, TaskError, point};
use unripple::core::{Outline, Point};

/// Largest number of points of a grid: a finer pitch is taken for a mistake of unit, and its responses would take terabytes.
const MOST: f64 = 1e6;

/// Points of a square grid (spacing `pitch`, in m) that lie inside an outline, at least a quarter of the
/// spacing from its rim: row by row from the bottom.
///
/// # Errors
/// [`TaskError::Ask`] of more than a million points, or none.
pub fn points(outline: &Outline, pitch: f64) -> Result<Vec<Point>, TaskError> {
    let (width, height) = outline.extent();
    let (columns, rows) = ((width / pitch).ceil(), (height / pitch).ceil());
    let refuse = |found: String| {
        let found = format!("{found} of {} mm", pitch * 1e3);
        TaskError::ask("pitch_m", format!("a grid of 1 to {MOST} points"), found)
    };
    if columns * rows > MOST {
        return Err(refuse(format!("{columns} x {rows}")));
    }
    let margin = pitch / 4.0;
    let well_inside = |p: &Point| {
        let around = [(margin, 0.0), (-margin, 0.0), (0.0, margin), (0.0, -margin), (0.0, 0.0)];
        around.iter().all(|(dx, dy)| outline.contains(Point::new(p.x + dx, p.y + dy)))
    };
    let (columns, rows) = (columns as usize, rows as usize);
    let all = (0..=rows).flat_map(|row| (0..=columns).map(move |column| (column, row)));
    let found: Vec<Point> = all
        .map(|(column, row)| Point::new(column as f64 * pitch, row as f64 * pitch))
        .filter(well_inside)
        .collect();
    if found.is_empty() { Err(refuse("none inside the rim".into())) } else { Ok(found) }
}

/// The points of a square grid with spacing `pitch` (m), if there is one, followed by the single points
/// `at`.
///
/// # Errors
/// [`TaskError::Ask`] of a pitch that gives no grid, and of a place beyond the edge.
pub fn places(outline: &Outline, pitch: Option<f64>, at: &[Place]) -> Result<Vec<Point>, TaskError> {
    let mut found = match pitch {
        Some(pitch) => points(outline, above_zero(pitch, "pitch_m", "m")?)?,
        None => Vec::new(),
    };
    for place in at {
        let at = point(place);
        if !outline.contains(at) {
            return Err(TaskError::ask(
                "points_m",
                "a point on the surface",
                format!("{at}, beyond its edge"),
            ));
        }
        found.push(at);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple::core::Shape;

    #[test]
    fn a_square_has_all_but_its_rim() {
        let film = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
        let grid = points(&film, 7.5e-3).unwrap();
        assert_eq!(grid.len(), 19 * 19);
        assert!(grid[0].distance(Point::from_mm(7.5, 7.5)) < 1e-12);
        assert!(grid[360].distance(Point::from_mm(142.5, 142.5)) < 1e-12);
        for pitch in [0.2, 1e-6] {
            assert!(points(&film, pitch).is_err());
        }
    }
}
