//! The frequency up to which a virtual surface needs modes.

use crate::DevicesError;
use unripple_core::Surface;
use unripple_physics::stepped_hz;

/// Top frequency of a surface's modes, in Hz: `asked`, or what the surface's band needs.
///
/// # Errors
/// [`DevicesError::Physics`] for actuators that are not valid.
pub(crate) fn top(surface: &Surface, asked: Option<f64>) -> Result<f64, DevicesError> {
    match asked {
        Some(top) => Ok(top),
        None => Ok(stepped_hz(surface, surface.emission.band[1])?),
    }
}
