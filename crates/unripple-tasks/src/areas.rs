//! Where actuators or sensors may be, as requests say it: distances from the rim, and areas.

use crate::{Place, TaskError, point};
use unripple::core::Point;

/// Least and greatest distance from the rim, in m; anywhere where the request says nothing.
///
/// # Errors
/// [`TaskError::Ask`] of distances that are negative or in the wrong order.
pub(crate) fn from_rim(rim_m: Option<[f64; 2]>) -> Result<[f64; 2], TaskError> {
    match rim_m {
        None => Ok([0.0, f64::INFINITY]),
        Some([least, most]) if least >= 0.0 && most > least => Ok([least, most]),
        Some([least, most]) => {
            let found = format!("{} and {} mm", 1e3 * least, 1e3 * most);
            Err(TaskError::ask("rim_m", "two distances, the second one larger", found))
        }
    }
}

/// The corners of polygons, in m, which a field of a request gives.
///
/// # Errors
/// [`TaskError::Ask`] of a polygon with fewer than three corners.
pub(crate) fn polygons(field: &'static str, areas: &[Vec<Place>]) -> Result<Vec<Vec<Point>>, TaskError> {
    let polygon = |area: &Vec<Place>| match area.len() {
        0..3 => {
            Err(TaskError::ask(field, "polygons of at least 3 corners", format!("{} corners", area.len())))
        }
        _ => Ok(area.iter().map(point).collect()),
    };
    areas.iter().map(polygon).collect()
}
