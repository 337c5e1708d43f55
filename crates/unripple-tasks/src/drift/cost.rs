//! Loss of peak and contrast of a focus whose drive was computed for an earlier tension.

use crate::TaskError;
use crate::position::anywhere;
use serde::Serialize;
use unripple::core::{Drive, ModalResponses, Point, Responses, Surface};
use unripple::field::{Field, Instant};
use unripple::focus::{Options, Target, focus};
use unripple::physics::design::Windows;

/// Cells of the evaluation grid per shortest wavelength: enough for ratios.
const CELLS: f64 = 4.0;

/// Peak and contrast of a time-reversal focus that is computed from the earlier responses, on the sheet
/// before and after its change of tension.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cost {
    /// Place of the focus, in m.
    pub at_m: [f64; 2],
    /// Window of the drive, in s: the default window of `focus`.
    pub window_s: f64,
    /// Peak velocity after the change of tension, relative to that before (ratio).
    pub peak_share: f64,
    /// Contrast before the change of tension (ratio).
    pub contrast_before: f64,
    /// Contrast after the change of tension (ratio).
    pub contrast_now: f64,
}

impl Cost {
    /// Computes a focus from the responses `before`, and evaluates it on them and on the responses `now`.
    ///
    /// # Errors
    /// Those of making and judging the focus.
    pub fn of(surface: &Surface, before: &ModalResponses, now: ModalResponses) -> Result<Self, TaskError> {
        let at = anywhere(&surface.outline);
        let [before, now] = [before.clone(), now].map(Responses::Modal);
        // That of a focus from the library, whatever was fitted.
        let window = Windows::of(surface).recommended().seconds;
        let options = Options { window, limit: surface.emission.limit, ..Options::default() };
        let drive = focus(&before, &[Target::at(at)], &options).map_err(TaskError::input)?.drive;
        let [then, found] = [judged(&before, &drive, at, window)?, judged(&now, &drive, at, window)?];
        Ok(Self {
            at_m: [at.x, at.y],
            window_s: window,
            peak_share: found.velocity / then.velocity,
            contrast_before: then.contrast().unwrap_or(0.0),
            contrast_now: found.contrast().unwrap_or(0.0),
        })
    }

    /// Contrast after the change of tension, relative to that before (ratio).
    pub fn contrast_share(&self) -> f64 {
        self.contrast_now / self.contrast_before
    }
}

fn judged(responses: &Responses, drive: &Drive, at: Point, instant: f64) -> Result<Instant, TaskError> {
    let field = Field::new(responses, drive, CELLS).map_err(TaskError::input)?;
    field.at_instant(instant, &[at], &[at]).map_err(TaskError::input)
}
