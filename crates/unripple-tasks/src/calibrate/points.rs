//! The places that a calibration measures: a grid, single points, the actuators themselves.

use super::ask::Ask;
use crate::TaskError;
use crate::grid;
use unripple::core::{Point, Surface};

/// The points at which responses are measured: those of a grid, then single points, then the positions of the actuators, where the
/// actuators' sensors measure.
#[derive(Clone, Debug, Default)]
pub struct Places {
    /// All points, those at the actuators last, in m.
    pub points: Vec<Point>,
    /// Number of points measured by a probe or by taps; the others lie at the actuators.
    pub probed: usize,
}

/// The points that a request names; if `sensing`, those at the actuators are added.
pub fn places(ask: &Ask, surface: &Surface, sensing: bool) -> Result<Places, TaskError> {
    let mut points = grid::places(&surface.outline, ask.pitch_m, &ask.points_m)?;
    let probed = points.len();
    if probed == 0 && !sensing {
        return Err(TaskError::Input(
            "expected `pitch_m` P or `points_m` X,Y: the places to be measured, found neither".into(),
        ));
    }
    if sensing {
        points.extend(surface.actuators.iter().map(|actuator| actuator.at));
    }
    Ok(Places { points, probed })
}

/// The middle of the rectangle around a surface, in m.
pub(crate) fn middle(surface: &Surface) -> Point {
    let (width, height) = surface.outline.extent();
    Point::new(width / 2.0, height / 2.0)
}
