//! The highest frequency of the modes that a virtual surface needs.

use crate::DevicesError;
use unripple_core::Surface;
use unripple_physics::stepped_hz;

/// Highest frequency of the modes computed for a surface, in Hz: `asked` if specified, otherwise what the
/// surface's band needs.
///
/// # Errors
/// [`DevicesError::Physics`] for actuators that are not valid.
pub(crate) fn top(surface: &Surface, asked: Option<f64>) -> Result<f64, DevicesError> {
    match asked {
        Some(top) => Ok(top),
        None => Ok(stepped_hz(surface, surface.emission.band[1])?),
    }
}
