//! Progress of a library that is being filled, and quality of its points.

use serde_json::{Value, json};
use std::path::PathBuf;
use unripple::core::Point;
use unripple_store::{Library, PointState};

/// Progress and quality of a library that is being filled.
pub struct Quality {
    folder: PathBuf,
    /// Signal-to-noise ratio in dB of points that were looked at: what is measured does not change.
    known: Vec<Option<f64>>,
}

impl Quality {
    /// Progress and quality of a library that may not exist yet.
    pub fn of(folder: PathBuf) -> Self {
        Self { folder, known: Vec::new() }
    }

    /// The fraction of the points that are done, and the place, state and signal-to-noise ratio of each
    /// point as JSON; `None` if there is no library yet.
    pub fn look(&mut self) -> (Option<f64>, Value) {
        let Ok(library) = Library::open(&self.folder) else { return (None, Value::Null) };
        let points = library.points();
        self.known.resize(points.len(), None);
        let mut done = 0;
        let mut told = Vec::with_capacity(points.len());
        for (index, at) in points.iter().enumerate() {
            let state = library.state(index).unwrap_or_default();
            done += usize::from(state != PointState::Missing);
            if state == PointState::Measured && self.known[index].is_none() {
                self.known[index] = worst(&library, index);
            }
            told.push(self.point(*at, state, self.known[index]));
        }
        (Some(done as f64 / points.len().max(1) as f64), json!({ "points": told }))
    }

    fn point(&self, at: Point, state: PointState, db: Option<f64>) -> Value {
        let state = match state {
            PointState::Missing => "todo",
            PointState::Measured => "done",
            PointState::Bad => "bad",
        };
        json!({ "at_mm": [at.x * 1e3, at.y * 1e3], "db": db, "state": state })
    }
}

/// The lowest signal-to-noise ratio of a point's responses, in dB.
fn worst(library: &Library, point: usize) -> Option<f64> {
    let qualities = library.quality(point).ok()?;
    let levels = qualities.iter().map(|quality| quality.signal_to_noise_db).filter(|db| db.is_finite());
    levels.reduce(f64::min)
}
