//! Interpolation of impulse responses between measured points: nearest point, linear, or kriging with the covariance
//! of waves.

mod bessel;
mod medium;
mod neighbourhood;
mod options;
mod plan;
mod spectra;
mod stray;
mod system;
mod triangles;
mod uncertainty;
mod wavelength;

pub use options::{BetweenOptions, Interpolation};
pub use plan::Between;
pub use uncertainty::Uncertainty;
pub use wavelength::{Wavelength, central, wavelength};
