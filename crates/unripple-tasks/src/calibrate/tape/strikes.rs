//! Recordings of taps and blows made elsewhere: which file was recorded at which place.

use super::planned::{SAME, Wanted, file, stem};
use crate::TaskError;
use crate::calibrate::ask::Ask;
use crate::calibrate::points::{self, Places};
use std::path::Path;
use unripple::core::{Point, Surface};
use unripple_calibrate::measure::MOST_REPEATS;
use unripple_exchange::Csv;

/// The places of a calibration by recordings of taps or blows, and the recordings: those that a table lists, or for each point the first
/// one, whether it is there or not, and the repeats of it that are in the folder.
pub fn wanted(ask: &Ask, surface: &Surface, folder: &Path) -> Result<(Places, Vec<Wanted>), TaskError> {
    if let Some(table) = &ask.table {
        return listed(ask, table, surface);
    }
    let places = points::places(ask, surface, false)?;
    let mut wanted = Vec::new();
    for (number, at) in places.points.iter().enumerate() {
        for repeat in 0..MOST_REPEATS {
            let file = file(&stem(number + 1, places.probed), repeat);
            if repeat > 0 && !folder.join(&file).is_file() {
                break;
            }
            wanted.push(Wanted { number, repeat, file, at: Some(*at) });
        }
    }
    Ok((places, wanted))
}

/// The recordings that a table lists, and their places in order of appearance.
fn listed(ask: &Ask, table: &Path, surface: &Surface) -> Result<(Places, Vec<Wanted>), TaskError> {
    if ask.pitch_m.is_some() || !ask.points_m.is_empty() {
        return Err(TaskError::ask("table", "no `pitch_m` and no `points_m` beside it", "both"));
    }
    let name = table.display().to_string();
    let bytes = std::fs::read(table).map_err(|error| TaskError::Input(format!("{name}: {error}")))?;
    let csv = Csv::of(&bytes, &name).map_err(TaskError::input)?;
    let column = |wanted: &str| {
        csv.column(wanted).ok_or_else(|| {
            let found = csv.names.join(", ");
            TaskError::Input(format!("{name}: expected columns file, x_mm and y_mm, found {found}"))
        })
    };
    let [file, x, y] = [column("file")?, column("x_mm")?, column("y_mm")?];
    let (mut points, mut wanted) = (Vec::<Point>::new(), Vec::<Wanted>::new());
    for row in csv.rows() {
        let row = row.map_err(TaskError::input)?;
        let fault = |expected: &str, found: &str| {
            TaskError::Input(format!("{name}: line {}: expected {expected}, found `{found}`", row.line))
        };
        let file = row.cells[file].trim();
        // A name alone: nothing outside the folder is read.
        if file.is_empty() || Path::new(file).file_name().is_none_or(|alone| alone != file) {
            return Err(fault("the name of a file in the folder", file));
        }
        if wanted.iter().any(|one| one.file == file) {
            return Err(fault("each file once", file));
        }
        let [x, y] = [x, y].map(|cell| row.cells[cell].trim());
        let at = match (x.parse::<f64>(), y.parse::<f64>()) {
            (Ok(x), Ok(y)) if x.is_finite() && y.is_finite() => Point::from_mm(x, y),
            _ => return Err(fault("a place in mm", &format!("{x}, {y}"))),
        };
        if !surface.outline.contains(at) {
            return Err(fault("a place on the surface", &at.to_string()));
        }
        let known = points.iter().position(|other| other.distance(at) < SAME);
        let number = known.unwrap_or_else(|| {
            points.push(at);
            points.len() - 1
        });
        let repeat = wanted.iter().filter(|one| one.number == number).count();
        wanted.push(Wanted { number, repeat, file: file.to_owned(), at: Some(at) });
    }
    match points.len() {
        0 => Err(TaskError::Input(format!("{name}: expected rows with recordings, found none"))),
        probed => Ok((Places { points, probed }, wanted)),
    }
}
