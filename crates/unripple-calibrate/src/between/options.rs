//! Method and options of the interpolation of responses between measured points.

use crate::CalibrateError;
use unripple_core::require;

/// Method of interpolating responses between measured points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// The response of the nearest point.
    Nearest,
    /// Linear over the Delaunay triangle of points around the place; beyond the outermost points, the value at the nearest
    /// place of their convex hull.
    Linear,
    /// Kriging: the most likely field of waves with the sheet's wavenumber at each frequency, given the responses at the
    /// points around the place.
    #[default]
    Kernel,
}

impl Interpolation {
    /// All methods, the simplest first.
    pub const ALL: [Self; 3] = [Self::Nearest, Self::Linear, Self::Kernel];

    /// Name of the method in reports and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Linear => "linear",
            Self::Kernel => "kernel",
        }
    }
}

/// Options of interpolation: the method, and the errors of the measured responses.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenOptions {
    /// Method of interpolation between points.
    pub interpolation: Interpolation,
    /// Rms of the noise in every response, relative to the rms of all responses; the noise is white up to
    /// half the sample rate.
    pub noise: f64,
    /// Rms of the relative error of each response's gain; the errors of different responses are independent.
    pub gain_error: f64,
    /// Rms distance of the points from their stated places, in metres.
    pub position_error: f64,
    /// The nugget of kriging: share (0 to 1) of the field's power in waves whose wavenumber differs from that of the
    /// dispersion relation, as edges, unevenness and errors of that relation cause.
    pub nugget: f64,
    /// Highest frequency of interpolated responses, as a multiple (1 to 10) of the top of the band. A raised
    /// cosine fades the spectrum out over the upper half of the range above the band.
    pub top: f64,
    /// Largest number of points (4 to 5000) in one system of kriging equations. More points are divided into overlapping
    /// neighbourhoods of half this number.
    pub most: usize,
}

impl Default for BetweenOptions {
    /// Kriging, with noise at -50 dB, gain errors of 0.5 % rms and no errors of position. The share of stray
    /// waves is a hundredth, as on surfaces with masses and uneven tension; a thousandth makes errors beside
    /// masses of 20 mg a quarter larger, and is no better without such masses.
    fn default() -> Self {
        Self {
            interpolation: Interpolation::Kernel,
            noise: 3.16e-3,
            gain_error: 5e-3,
            position_error: 0.0,
            nugget: 1e-2,
            top: 1.1,
            most: 500,
        }
    }
}

impl BetweenOptions {
    /// Checks that every option is in its range.
    pub(crate) fn check(&self) -> Result<(), CalibrateError> {
        let share = |x: f64| (0.0..=1.0).contains(&x);
        let length = self.position_error.is_finite() && self.position_error >= 0.0;
        require("noise", share(self.noise), "0 to 1", self.noise)?;
        require("gain error", share(self.gain_error), "0 to 1", self.gain_error)?;
        require("position error (m)", length, "0 or more", self.position_error)?;
        require("share of stray waves", share(self.nugget), "0 to 1", self.nugget)?;
        require("top over the band's", (1.0..=10.0).contains(&self.top), "1 to 10", self.top)?;
        let most = self.most as f64;
        Ok(require("points solved together", (4..=5000).contains(&self.most), "4 to 5000", most)?)
    }
}
