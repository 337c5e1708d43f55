//! Expected error of interpolated responses: the kriging variance.

/// Expected error of the interpolated responses at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    /// Frequencies, in Hz, ascending from 0 to the highest that is interpolated.
    pub hz: Vec<f64>,
    /// Expected power of the error at each frequency of `hz`, relative to the mean power of the responses at
    /// the measured points.
    pub share: Vec<f64>,
    /// Expected error of each actuator's response, rms over its samples, in m/s per unit impulse of drive.
    pub rms: Vec<f64>,
    /// The rms of the expected error relative to the rms of all responses at the measured points, a ratio.
    pub relative: f64,
}
