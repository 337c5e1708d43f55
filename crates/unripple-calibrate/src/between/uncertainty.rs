//! Expected error of interpolated responses: the kriging variance.

/// How far an interpolated response is expected to be off.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    /// Frequencies, in Hz, ascending from 0 to the top of what is kept.
    pub hz: Vec<f64>,
    /// At each of them the expected power of the error, over the mean power of the responses at the points.
    pub share: Vec<f64>,
    /// Rms over the response of the expected error for each actuator, in m/s per unit impulse of drive.
    pub rms: Vec<f64>,
    /// The rms of the expected error over the rms of all responses at the points, a ratio.
    pub relative: f64,
}
