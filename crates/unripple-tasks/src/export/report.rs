//! Report of the task `export`.

use serde::Serialize;
use unripple::act::Note;

/// Result of exporting a library.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// Path of the library, as in the request.
    pub library: String,
    /// Format of the export: `wav`, `sofa`, `uff`, `uff-modes` or `mat`.
    pub format: &'static str,
    /// Path of the export.
    pub output: String,
    /// Number of points that were written.
    pub points: usize,
    /// Number of points left out because they are missing or bad.
    pub points_left_out: usize,
    /// Number of points left out because they are bad; counted in `points_left_out` too.
    pub points_bad: usize,
    /// Number of actuators.
    pub actuators: usize,
    /// Number of samples in each response.
    pub samples: usize,
    /// Sample rate of the responses, in Hz.
    pub sample_rate_hz: f64,
    /// Notes on the library.
    pub notes: Vec<Note>,
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let left = match self.points_left_out {
            0 => String::new(),
            left => {
                format!(" ({left} left out: {} bad, {} missing)", self.points_bad, left - self.points_bad)
            }
        };
        format!(
            "{}: {} points of {} actuators, {} samples at {} Hz{left}\nwrote {}\n",
            self.library, self.points, self.actuators, self.samples, self.sample_rate_hz, self.output
        )
    }
}
