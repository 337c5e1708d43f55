//! Report of the task `respond`.

use serde::Serialize;
use unripple::act::at_most;

/// The library of responses that was written.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the program.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the task.
    pub command: &'static str,
    /// Name of the surface in its file.
    pub surface: String,
    /// Path of the library's folder.
    pub library: String,
    /// Number of points in the library.
    pub points: usize,
    /// Number of points that an earlier run had finished.
    pub points_found_done: usize,
    /// Distance between neighbouring points, in m.
    pub pitch_m: f64,
    /// Number of actuators.
    pub actuators: usize,
    /// Number of samples in each response.
    pub samples: usize,
    /// Sample rate of the responses, in Hz.
    pub sample_rate_hz: f64,
    /// Shortest wavelength of the band, in m.
    pub lambda_min_m: f64,
    /// Upper bound of the relative error of the responses, root mean square over their length and all points and actuators, by the errors
    /// of modes and samples; `None` if it is not known, as with loads on the sheet.
    pub response_error: Option<f64>,
    /// Upper bound of the share that modes above the band, which are left out, have in the motion within the band, root mean square,
    /// relative to the responses; `None` if it is not known.
    pub left_out: Option<f64>,
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let taken_up = match self.points_found_done {
            0 => String::new(),
            before => format!(", {before} of them done before"),
        };
        let known = |share: Option<f64>| share.map_or("not known".into(), at_most);
        format!(
            "{}: responses of {} actuators at {} points, {} mm apart{taken_up}\n{} samples each, {:.3} ms at {} Hz\n\
             error of the responses: {}\nshare of the modes above the band, which are left out: {}\nwrote {}\n",
            self.surface,
            self.actuators,
            self.points,
            rounded(self.pitch_m * 1e3),
            self.samples,
            (self.samples - 1) as f64 / self.sample_rate_hz * 1e3,
            self.sample_rate_hz,
            known(self.response_error),
            known(self.left_out),
            self.library
        )
    }
}

/// A length in mm without the rounding errors of the conversion from metres.
fn rounded(mm: f64) -> f64 {
    (mm * 1e9).round() / 1e9
}
