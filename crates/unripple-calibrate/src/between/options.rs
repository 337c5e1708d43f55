//! How responses between measured points are interpolated.

use crate::CalibrateError;
use unripple_core::require;

/// How responses between the points are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// The response of the nearest point.
    Nearest,
    /// Linear over the triangle of points around the place (Delaunay); beyond the outermost points, along their hull.
    Linear,
    /// The most likely field of waves with the sheet's own wavenumber at each frequency, given all points around.
    #[default]
    Kernel,
}

impl Interpolation {
    /// Every way, the simplest first.
    pub const ALL: [Self; 3] = [Self::Nearest, Self::Linear, Self::Kernel];

    /// Name of the method in figures and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Linear => "linear",
            Self::Kernel => "kernel",
        }
    }
}

/// How responses between the points are made, and what is known of the errors of those at the points.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenOptions {
    /// The way of interpolating.
    pub interpolation: Interpolation,
    /// Rms of the noise that adds to every response, over the rms of all responses; white up to half the sample rate.
    pub noise: f64,
    /// Rms of the relative error of each response's gain, independent from one to the next.
    pub gain_error: f64,
    /// Rms distance of the points from where they are said to be, in metres.
    pub position_error: f64,
    /// The nugget: share of the power in waves of other wavenumbers than the dispersion relation's, as edges,
    /// unevenness and errors of that relation make them.
    pub nugget: f64,
    /// Top of what is kept over the top of the band, at least 1; a raised cosine ends it over the upper half of the excess.
    pub top: f64,
    /// Most points that are solved together; of more, each neighbourhood has half as many of its own.
    pub most: usize,
}

impl Default for BetweenOptions {
    /// The kernel, with noise at -50 dB, gains within 0.5 %, points where they are said to be.
    fn default() -> Self {
        Self {
            interpolation: Interpolation::Kernel,
            noise: 3.16e-3,
            gain_error: 5e-3,
            position_error: 0.0,
            nugget: 1e-3,
            top: 1.1,
            most: 500,
        }
    }
}

impl BetweenOptions {
    /// Refuses numbers without meaning.
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
